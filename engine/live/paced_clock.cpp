#include "engine/live/paced_clock.hpp"

#include <algorithm>
#include <vector>

#include "base/realtime.hpp"
#include "base/sleep_until.hpp"
#include "base/thread_priority.hpp"

namespace raks::engine {
namespace {

// About 5 ms at 48 kHz: as fine as a device's own blocks.
constexpr std::int64_t kBlockFrames = 256;
// After a longer stall (a suspended machine) the clock goes on from now instead of racing after.
constexpr Nanos kMaxBehind = std::chrono::milliseconds(500);

}  // namespace

PacedClock::PacedClock(Direction direction,
                       SampleRate rate,
                       int channels,
                       audio::StreamCallback& callback)
    : callback_(callback), thread_([=, this] { run(direction, rate, channels); }) {}

PacedClock::~PacedClock() {
    is_stopping_.store(true, std::memory_order_relaxed);  // relaxed: join() orders the rest
    thread_.join();
}

void PacedClock::run(Direction direction, SampleRate rate, int channels) noexcept {
    const FlushToZeroScope flush_to_zero;
    prefer_this_thread(RealtimeThread::callback);
    std::vector<float> block(static_cast<std::size_t>(kBlockFrames * channels));
    // Each block is due at the start plus its own frame number: the rate is exact in the long run.
    HostTime start = HostClock::now();
    std::int64_t frame = 0;
    while (!is_stopping_.load(std::memory_order_relaxed)) {  // relaxed: see the destructor
        const HostTime due = start + rate.time_of(frame).time_since_epoch();
        sleep_until(due);
        const HostTime now = HostClock::now();
        // Moves the start, so that the blocks of the stall are not called one after the other.
        if (now - due > kMaxBehind) {
            start += now - due;
        }
        // Silence for an input; a zeroed block for an output, as the callback expects.
        std::fill(block.begin(), block.end(), 0.0F);
        const audio::BlockTime time{frame, now, false};
        if (direction == Direction::input) {
            callback_.on_input(block, channels, time);
        } else {
            callback_.on_output(block, channels, time);
        }
        frame += kBlockFrames;
    }
}

}  // namespace raks::engine
