#include "engine/motion_thread.hpp"

#include <ctime>

#include <utility>

#include "base/realtime.hpp"

namespace raks::engine {
namespace {

// Well under a hop, so that a state waits at most this long; the thread sleeps 98 % of the time.
constexpr std::int64_t kNapNanos = 2'000'000;

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

MotionThread::MotionThread(motion::Dancer dancer,
                           EventQueue<MusicState>& states,
                           EventQueue<DancedHop>* record)
    : dancer_(std::move(dancer)),
      states_(states),
      record_(record),
      commands_(64),
      stage_(std::make_unique<StageState>()),
      thread_([this] { run(); }) {}

MotionThread::~MotionThread() {
    is_stopping_.store(true, std::memory_order_relaxed);  // relaxed: join() orders the rest
    thread_.join();
}

void MotionThread::run() noexcept {
    const FlushToZeroScope flush_to_zero;
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        if (tick()) {
            published_.write(*stage_);
        }
        nap();
    }
}

bool MotionThread::tick() noexcept {
    motion::DancerCommand command{};
    while (commands_.pop(command)) {
        dancer_.command(command);
    }
    bool has_danced = false;
    while (states_.pop(stage_->music)) {
        dancer_.advance(stage_->music, stage_->track);
        stage_->dancer = dancer_.status();
        if (record_ != nullptr) {
            record_->push({stage_->music.hop, stage_->track.at_hop(stage_->music.hop)});
        }
        // release: pairs with the acquire in danced_hops(): the record is there when it is counted.
        danced_hops_.fetch_add(1, std::memory_order_release);
        has_danced = true;
    }
    stage_->published_at_ns = HostClock::now().time_since_epoch().count();
    return has_danced;
}

}  // namespace raks::engine
