#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/realtime.hpp"

namespace raks::audio {

/// Power spectrum of one windowed stretch of real samples (kissfft, planned when made).
/// Threads: one. Real-time: compute yes.
class PowerSpectrum {
 public:
    /// `window`: factors of the samples, window.size() <= fft_size; the rest of the FFT is zeros.
    /// `fft_size`: even.
    PowerSpectrum(std::vector<float> window, int fft_size);
    /// Frees the plan.
    ~PowerSpectrum();
    /// Movable, not copyable.
    PowerSpectrum(PowerSpectrum&&) noexcept;
    /// As above.
    PowerSpectrum& operator=(PowerSpectrum&&) noexcept;

    /// |X|^2 of bins 0 .. fft_size / 2, not normalized. `samples`: as many as the window has. The
    /// result is valid until the next call.
    std::span<const float> compute(std::span<const float> samples) noexcept RAKS_NONBLOCKING;

    /// Number of bins: fft_size / 2 + 1.
    [[nodiscard]] int bins() const noexcept;

 private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// Symmetric Hann window, 0.5 - 0.5 cos(2 pi i / (size - 1)) over i = 0 .. size - 1.
[[nodiscard]] std::vector<float> hann_window(int size);
/// Symmetric Hamming window, 0.54 - 0.46 cos(2 pi i / (size - 1)).
[[nodiscard]] std::vector<float> hamming_window(int size);

}  // namespace raks::audio
