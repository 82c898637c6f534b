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
    /// `window`: what the samples are multiplied by, window.size() <= fft_size; the rest is zeros.
    /// `fft_size`: even.
    PowerSpectrum(std::vector<float> window, int fft_size);
    ~PowerSpectrum();
    PowerSpectrum(PowerSpectrum&&) noexcept;
    PowerSpectrum& operator=(PowerSpectrum&&) noexcept;

    /// |X|^2 of bins 0 .. fft_size / 2 of `samples` (as many as the window has), not normalized.
    std::span<const float> compute(std::span<const float> samples) noexcept RAKS_NONBLOCKING;

    [[nodiscard]] int bins() const noexcept;

 private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// Symmetric windows: w[i] over i = 0 .. size - 1.
[[nodiscard]] std::vector<float> hann_window(int size);
[[nodiscard]] std::vector<float> hamming_window(int size);  ///< 0.54 - 0.46 cos

}  // namespace raks::audio
