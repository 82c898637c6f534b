#pragma once

#include <span>
#include <vector>

#include "audio/features/real_fft.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Power spectrum of one windowed stretch of real samples (RealFft, planned when made).
/// Threads: one. Real-time: compute, compute_magnitudes yes.
class PowerSpectrum {
 public:
    /// `window`: factors of the samples, window.size() <= fft_size; the rest of the FFT is zeros.
    /// `fft_size`: a power of two, 128 to 65,536.
    PowerSpectrum(std::vector<float> window, int fft_size);

    /// |X|^2 of bins 0 .. fft_size / 2, not normalized. `samples`: as many as the window has. The
    /// result is valid until the next call.
    std::span<const float> compute(std::span<const float> samples) noexcept RAKS_NONBLOCKING;
    /// |X| of the same bins.
    std::span<const float> compute_magnitudes(std::span<const float> samples) noexcept
        RAKS_NONBLOCKING;

    /// Number of bins: fft_size / 2 + 1.
    [[nodiscard]] int bins() const noexcept { return static_cast<int>(power_.size()); }

 private:
    std::vector<float> window_;
    std::vector<float> samples_;  // longer than the window: what is behind it stays 0
    std::vector<float> power_;
    std::vector<float> magnitudes_;
    RealFft transform_;
};

/// Symmetric Hann window, 0.5 - 0.5 cos(2 pi i / (size - 1)) over i = 0 .. size - 1.
[[nodiscard]] std::vector<float> hann_window(int size);
/// Symmetric Hamming window, 0.54 - 0.46 cos(2 pi i / (size - 1)).
[[nodiscard]] std::vector<float> hamming_window(int size);

/// Triangular filters over a power or magnitude spectrum, kept sparse.
/// Immutable once made. Real-time: apply yes.
class FilterBank {
 public:
    /// One filter: the weights of consecutive bins from `first_bin` on; without weights it gives 0.
    struct Filter {
        int first_bin = 0;           ///< FFT bin of the first weight
        std::vector<float> weights;  ///< one a bin
    };
    /// A bank with one band a filter, in this order.
    explicit FilterBank(std::vector<Filter> filters);

    /// bands[i] = sum over the filter's bins of spectrum x weight. `bands.size()` == size().
    /// `spectrum`: at least as many bins as the filters cover.
    void apply(std::span<const float> spectrum,
               std::span<float> bands) const noexcept RAKS_NONBLOCKING;

    /// Number of filters, which is the number of bands.
    [[nodiscard]] int size() const noexcept { return static_cast<int>(filters_.size()); }
    /// How many filters, counted from the first, have no weight above this bin.
    [[nodiscard]] int size_below(int bin) const noexcept;

 private:
    std::vector<Filter> filters_;
};

/// Range and resolution of a bank of mel filters.
struct MelConfig {
    int sample_rate = 16'000;  ///< hertz
    int fft_size = 512;        ///< samples; the spectrum has half as many bins plus one
    int bands = 26;            ///< number of filters
    double low_hz = 0.0;       ///< lower edge of the first filter
    double high_hz = 8'000.0;  ///< upper edge of the last filter
};

/// HTK's bank: centres equally spaced in mel = 1127 ln(1 + f / 700), triangles linear in mel, each
/// bin shared between two neighbouring filters; DC and Nyquist never count. (HTK book 5.4)
[[nodiscard]] FilterBank htk_filter_bank(const MelConfig& config);

/// Triangles of peak 1, linear in hertz, with corners equally spaced in mel. A band narrower than a
/// bin takes the nearest bin with weight 1.
[[nodiscard]] FilterBank triangular_filter_bank(const MelConfig& config);

}  // namespace raks::audio
