#include "tests/support/stall_watch.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>

namespace raks::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(2);
constexpr std::chrono::milliseconds kLate(2);
constexpr int kAboveJack = 90;  // the tests' servers run at 70

}  // namespace

StallWatch::StallWatch() : lost_ns_(std::max(1U, std::thread::hardware_concurrency())) {
    for (std::size_t core = 0; core < lost_ns_.size(); ++core) {
        threads_.emplace_back([this, core] { watch(core); });
    }
}

StallWatch::~StallWatch() {
    ends_ = true;
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void StallWatch::watch(std::size_t core) noexcept {
    // Both are refused on some machines: then this sees a little more than the machine's stalls.
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(core, &cores);
    pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
    const sched_param priority{.sched_priority = kAboveJack};
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
    for (Clock::time_point due = Clock::now() + kLook; !ends_; due += kLook) {
        std::this_thread::sleep_until(due);
        const Clock::time_point now = Clock::now();
        if (now - due > kLate) {
            lost_ns_[core] += std::chrono::nanoseconds(now - due).count();
            due = now;
        }
    }
}

std::chrono::nanoseconds StallWatch::lost() const noexcept {
    std::int64_t most = 0;
    for (const auto& lost : lost_ns_) {
        most = std::max(most, lost.load());
    }
    return std::chrono::nanoseconds(most);
}

bool StallWatch::is_machine_slow() const noexcept { return lost() * 200 > Clock::now() - start_; }

}  // namespace raks::test
