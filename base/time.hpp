#pragma once

#include <chrono>
#include <compare>
#include <cstdint>

#include "base/realtime.hpp"

/// Time on the stream's and the host's clock, hops and sample rates.
namespace raks {

/// A span of time.
using Nanos = std::chrono::nanoseconds;

/// The clock of all analysis and motion: audio time since the stream's first sample. It has no
/// now(), because only samples advance it. Two of its time points cannot be added.
struct StreamClock {
    // Names that std::chrono requires of a clock.
    using rep = std::int64_t;
    using period = std::nano;
    using duration = Nanos;
    using time_point = std::chrono::time_point<StreamClock, Nanos>;
    static constexpr bool is_steady = true;  ///< never set back
};
using StreamTime = StreamClock::time_point;

/// CLOCK_MONOTONIC. Only `engine` maps HostTime to StreamTime and back.
using HostClock = std::chrono::steady_clock;
using HostTime = std::chrono::time_point<HostClock, Nanos>;

/// Now. Threads: any. Real-time: yes.
[[nodiscard]] inline HostTime host_now() noexcept RAKS_NONBLOCKING {
    // CLOCK_MONOTONIC is read from memory that the kernel shares.
    return RAKS_TRUSTED(HostClock::now());
}

/// Analysis and motion run once a hop; hop n is at exactly n x 10 ms.
inline constexpr Nanos kHop = std::chrono::milliseconds(10);
inline constexpr double kHopsPerSecond = 100.0;  ///< rate of features and states

/// Number of a hop since the stream's start, >= 0.
using HopIndex = std::int64_t;

/// Time of a hop.
[[nodiscard]] constexpr StreamTime time_of_hop(HopIndex hop) noexcept {
    return StreamTime(hop * kHop);
}

/// Seconds in a span.
[[nodiscard]] constexpr double to_seconds(Nanos span) noexcept {
    return static_cast<double>(span.count()) * 1e-9;
}

/// Seconds since the stream's first sample.
[[nodiscard]] constexpr double to_seconds(StreamTime time) noexcept {
    return to_seconds(time.time_since_epoch());
}

/// Span of so many seconds, to the nearest nanosecond; |seconds| < 9e9.
[[nodiscard]] constexpr Nanos nanos_from_seconds(double seconds) noexcept {
    return Nanos(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

/// Time so many seconds after the stream's first sample.
[[nodiscard]] constexpr StreamTime stream_time_from_seconds(double seconds) noexcept {
    return StreamTime(nanos_from_seconds(seconds));
}

/// Samples per second of one channel. Raks accepts 8,000 to 192,000 Hz.
class SampleRate {
 public:
    /// Any number; see is_supported.
    constexpr explicit SampleRate(int hertz) noexcept : hertz_(hertz) {}
    [[nodiscard]] constexpr int hertz() const noexcept { return hertz_; }  ///< samples a second
    /// In the accepted range?
    [[nodiscard]] constexpr bool is_supported() const noexcept {
        return hertz_ >= 8'000 && hertz_ <= 192'000;
    }

    /// Time of the sample with this index: rounded down to the nanosecond, without accumulating
    /// error.
    [[nodiscard]] constexpr StreamTime time_of(std::int64_t sample_index) const noexcept {
        return StreamTime(Nanos(sample_index / hertz_ * 1'000'000'000 +
                                sample_index % hertz_ * 1'000'000'000 / hertz_));
    }
    /// Index of the first sample at or after `time` (>= 0).
    [[nodiscard]] constexpr std::int64_t index_at(StreamTime time) const noexcept {
        const std::int64_t ns = time.time_since_epoch().count();
        return ns / 1'000'000'000 * hertz_ +
               (ns % 1'000'000'000 * hertz_ + 999'999'999) / 1'000'000'000;
    }

    friend constexpr auto operator<=>(SampleRate, SampleRate) = default;  ///< by hertz

 private:
    int hertz_;
};

}  // namespace raks
