#include "audio/beat/tap_tempo.hpp"

#include <algorithm>

namespace raks::audio {
namespace {
constexpr Nanos kLongestPause = std::chrono::seconds(2);   // longer: a new series
constexpr Nanos kBounce = std::chrono::milliseconds(120);  // 500 BPM: a key that bounced
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
    std::array<double, kTaps - 1> intervals{};
    const std::size_t n = count_ - 1;
    // The median: one tap that is late or early spoils two intervals, but not the tempo.
    for (std::size_t i = 0; i < n; ++i) {
        intervals[i] = to_seconds(taps_[i + 1] - taps_[i]);
    }
    std::sort(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(n));
    const double median =
        n % 2 == 1 ? intervals[n / 2] : 0.5 * (intervals[n / 2 - 1] + intervals[n / 2]);
    return 60.0 / median;
}

}  // namespace raks::audio
