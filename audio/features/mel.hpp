#pragma once

#include <span>
#include <vector>

#include "base/realtime.hpp"

namespace raks::audio {

/// Triangular filters over a power or magnitude spectrum, kept sparse.
/// Immutable once made. Real-time: apply yes.
class FilterBank {
 public:
    /// One filter: weights of consecutive bins from `first_bin` on.
    struct Filter {
        int first_bin = 0;
        std::vector<float> weights;
    };
    explicit FilterBank(std::vector<Filter> filters);

    /// bands[i] = sum of spectrum x weights. `bands.size()` == size().
    void apply(std::span<const float> spectrum,
               std::span<float> bands) const noexcept RAKS_NONBLOCKING;

    [[nodiscard]] int size() const noexcept { return static_cast<int>(filters_.size()); }
    /// How many filters, from the first on, end at or below this bin.
    [[nodiscard]] int size_below(int bin) const noexcept;

 private:
    std::vector<Filter> filters_;
};

/// What a bank of mel filters covers.
struct MelConfig {
    int sample_rate = 16'000;
    int fft_size = 512;
    int bands = 26;
    double low_hz = 0.0;
    double high_hz = 8'000.0;
};

/// HTK's bank: centres equally spaced in mel = 1127 ln(1 + f / 700), triangles linear in mel, each
/// bin shared between two neighbouring filters; DC and Nyquist never count. (HTK book 5.4)
[[nodiscard]] FilterBank htk_filter_bank(const MelConfig& config);

/// Triangles of peak 1, linear in Hz, corners equally spaced in mel. Bands narrower than a bin take
/// their nearest bin.
[[nodiscard]] FilterBank triangular_filter_bank(const MelConfig& config);

}  // namespace raks::audio
