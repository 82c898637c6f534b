#include "engine/live/sleep_watch.hpp"

#include <ctime>

namespace raks::engine {
namespace {

Nanos now_on(clockid_t clock) noexcept {
    timespec time{};
    clock_gettime(clock, &time);
    return std::chrono::seconds(time.tv_sec) + Nanos(time.tv_nsec);
}

}  // namespace

std::optional<Nanos> SleepWatch::look() noexcept {
    return look(now_on(CLOCK_BOOTTIME), now_on(CLOCK_MONOTONIC));
}

}  // namespace raks::engine
