#include "audio/beat/tap_tempo.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace raks::audio {
namespace {
constexpr Nanos kLongestPause = std::chrono::seconds(2);   // longer: a new series
constexpr Nanos kBounce = std::chrono::milliseconds(120);  // 500 BPM: a key that bounced

double median_of(std::span<double> values) noexcept RAKS_NONBLOCKING {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}
}  // namespace

std::optional<double> TapTempo::tap(StreamTime time) noexcept RAKS_NONBLOCKING {
    // A tap before the last one belongs to another position of the stream.
    if (count_ > 0 && (time - taps_[count_ - 1] > kLongestPause || time < taps_[count_ - 1])) {
        count_ = 0;
    }
    if (count_ > 0 && time - taps_[count_ - 1] < kBounce) {
        return std::nullopt;
    }
    if (count_ == kTaps) {
        std::copy(taps_.begin() + 1, taps_.end(), taps_.begin());
        --count_;
    }
    taps_[count_++] = time;
    if (count_ < 3) {
        return std::nullopt;
    }
    const double usual = usual_interval();
    const std::size_t first = first_of_this_tempo(usual);
    // The beats between two taps: one that was left out does not count as a slow one.
    std::array<double, kTaps> beats{};
    for (std::size_t i = first + 1; i < count_; ++i) {
        const double interval = to_seconds(taps_[i] - taps_[i - 1]);
        beats[i] = beats[i - 1] + std::max(1.0, std::round(interval / usual));
    }
    std::array<double, kTaps*(kTaps - 1) / 2> slopes{};
    std::size_t n = 0;
    for (std::size_t i = first; i < count_; ++i) {
        for (std::size_t j = i + 1; j < count_; ++j) {
            slopes[n++] = to_seconds(taps_[j] - taps_[i]) / (beats[j] - beats[i]);
        }
    }
    return 60.0 / median_of(std::span(slopes).first(n));
}

// Of the last seven: after four others it is theirs.
double TapTempo::usual_interval() const noexcept RAKS_NONBLOCKING {
    constexpr std::size_t kLooked = 7;
    std::array<double, kLooked> intervals{};
    const std::size_t n = std::min(count_ - 1, kLooked);
    for (std::size_t i = 0; i < n; ++i) {
        intervals[i] = to_seconds(taps_[count_ - 1 - i] - taps_[count_ - 2 - i]);
    }
    return median_of(std::span(intervals).first(n));
}

// Before it two intervals in a row were longer, or shorter: another tempo. A bad tap makes one of
// each.
std::size_t TapTempo::first_of_this_tempo(double usual) const noexcept RAKS_NONBLOCKING {
    constexpr double kOther = 0.12;  // of a beat
    double newer = 0.0;
    for (std::size_t i = count_ - 1; i > 0; --i) {
        const double beats = to_seconds(taps_[i] - taps_[i - 1]) / usual;
        const double off = beats - std::max(1.0, std::round(beats));
        if (std::abs(off) > kOther && std::abs(newer) > kOther && off * newer > 0.0) {
            // At least two intervals are left.
            return std::min(i + 1, count_ - 3);
        }
        newer = off;
    }
    return 0;
}

}  // namespace raks::audio
