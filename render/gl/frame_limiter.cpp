#include "render/gl/frame_limiter.hpp"

#include <cerrno>
#include <ctime>

namespace raks::render {

void sleep_until(HostTime due) noexcept {
    const auto ns = due.time_since_epoch().count();
    const timespec when{.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
    // A signal ends the sleep early; the time is absolute, so sleeping again does not add to it.
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
    }
}

}  // namespace raks::render
