#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/dance_list.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"
#include "engine/live/clock_map.hpp"
#include "engine/live/stage_state.hpp"

namespace raks::engine {

/// Stream time and host time as they are heard: a straight line.
struct HeardLine {
    ClockLine clock;      ///< when a moment of the stream is handed to the device, or came from it
    Nanos heard_after{};  ///< how long after that it is heard

    /// The host time at which stream time `t` is heard; while nothing runs, that of the last block.
    [[nodiscard]] HostTime heard_at(StreamTime t) const noexcept {
        return clock.host_at(t) + heard_after;
    }
    /// What is heard at a host time; stands still while nothing runs.
    [[nodiscard]] StreamTime heard_by(HostTime host) const noexcept {
        return clock.stream_at(host) - heard_after;
    }
};

/// What the first dancer does at a hop.
struct FeedFigure {
    std::array<char, 32> name{};    ///< zero-terminated; empty while standing
    int counts = 0;                 ///< its length in beats
    DanceId dance = DanceId::none;  ///< none while standing, or where nobody dances
    friend bool operator==(const FeedFigure&, const FeedFigure&) = default;
};

/// One hop, as readers on other threads are told it.
struct FeedHop {
    MusicState music;   ///< what is known at it
    FeedFigure figure;  ///< what is danced to it
};

/// What one piece of music says, hop by hop, and when that is heard, for one reader on a thread of
/// its own. A reader of beats has all it needs here and costs no copy of a pose; one of poses asks
/// for the stage.
///
/// Without dancers the audio thread tells the hops.
///
/// Threads: what is marked *motion*, *audio*, *main* and *reader* from that one alone; the reader
/// may change, where the one before has finished. Real-time: all of it.
class MusicFeed {
 public:
    /// Hops wait here for the reader: 2.5 s of them.
    static constexpr std::size_t kRoom = 256;

    /// *motion* One hop, in order; dropped and counted where the reader is behind.
    void tell(const FeedHop& hop) noexcept RAKS_NONBLOCKING { hops_.push(hop); }
    /// *audio* The clock as of the newest block.
    void set_clock(const ClockLine& line) noexcept RAKS_NONBLOCKING { clock_.write(line); }
    /// *main* What heard_line() adds to the clock.
    void set_heard_after(Nanos span) noexcept RAKS_NONBLOCKING {
        heard_after_ns_.store(span.count(), std::memory_order_relaxed);  // a number by itself
    }

    /// *main* From now on the stage is shown, too: the motion thread copies it (70 kB a dancer) at
    /// each wake-up. Real-time: no (allocates, the first time).
    void ask_for_stage() {
        if (!stages_) {
            stages_ = std::make_unique<StageChannel>();
            // release: pairs with the acquires in show() and stage(), which see the whole channel.
            asked_.store(stages_.get(), std::memory_order_release);
        }
    }
    /// *motion* The stage as of this wake-up; nothing happens where nobody asked for it.
    void show(const StageState& stage) noexcept RAKS_NONBLOCKING {
        // acquire: see ask_for_stage()
        if (StageChannel* const channel = asked_.load(std::memory_order_acquire)) {
            channel->write_with([&stage](StageState& slot) { slot.copy_used(stage); });
        }
    }

    /// *reader* The next hop; false: none waits.
    [[nodiscard]] bool take(FeedHop& hop) noexcept RAKS_NONBLOCKING { return hops_.pop(hop); }
    /// *reader* When it is heard, as far as is known now.
    [[nodiscard]] HeardLine heard_line() noexcept RAKS_NONBLOCKING {
        // relaxed: see set_heard_after()
        return {clock_.read(), Nanos(heard_after_ns_.load(std::memory_order_relaxed))};
    }
    /// *reader* The newest stage, which holds until the next call; null: nobody has danced since it
    /// was asked for.
    [[nodiscard]] const StageState* stage() noexcept RAKS_NONBLOCKING {
        // acquire: see ask_for_stage()
        StageChannel* const channel = asked_.load(std::memory_order_acquire);
        const StageState* const newest = channel != nullptr ? &channel->read() : nullptr;
        return newest != nullptr && newest->published_at_ns != 0 ? newest : nullptr;
    }
    /// Hops that the reader was too slow for, so far. Threads: any.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return hops_.dropped(); }

 private:
    EventQueue<FeedHop> hops_{kRoom};
    LatestValue<ClockLine> clock_;
    std::atomic<std::int64_t> heard_after_ns_{0};
    std::unique_ptr<StageChannel> stages_;  // main's; null: nobody asked
    std::atomic<StageChannel*> asked_{nullptr};
};

}  // namespace raks::engine
