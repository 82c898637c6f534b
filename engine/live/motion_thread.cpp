#include "engine/live/motion_thread.hpp"

#include <ctime>

#include <utility>

namespace raks::engine {
namespace {

// Well under a hop (10 ms): a state waits at most this long. Between ticks the thread sleeps, 98 %
// of the time.
constexpr std::int64_t kNapNanos = 2'000'000;

// Sleeps until an absolute time, so that an interrupted call cannot lengthen the nap.
void nap() noexcept {
    timespec until{};
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += kNapNanos;
    if (until.tv_nsec >= 1'000'000'000) {
        until.tv_nsec -= 1'000'000'000;
        ++until.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

MotionThread::MotionThread(motion::Ensemble dancers, MotionStage::Wiring wiring)
    : stage_(std::move(dancers), std::move(wiring)), thread_([this] { run(); }) {}

MotionThread::~MotionThread() {
    is_stopping_.store(true, std::memory_order_relaxed);  // relaxed: join() orders the rest
    thread_.join();
}

// Naps after every tick: the stage publishes at most every 2 ms.
void MotionThread::run() noexcept {
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        stage_.tick();
        nap();
    }
}

}  // namespace raks::engine
