#pragma once

#include <ctime>

#include "base/time.hpp"

namespace raks {

/// A moment of CLOCK_MONOTONIC as the system's calls take it.
[[nodiscard]] inline timespec timespec_of(HostTime time) noexcept {
    const auto nanos = time.time_since_epoch().count();
    timespec moment{};
    moment.tv_sec = nanos / 1'000'000'000;
    moment.tv_nsec = nanos % 1'000'000'000;
    return moment;
}

/// Sleeps until then; errors of single sleeps do not add up. A signal may end it early.
/// Threads: any. Real-time: for the motion thread alone.
inline void sleep_until(HostTime time) noexcept {
    const timespec moment = timespec_of(time);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &moment, nullptr);
}

}  // namespace raks
