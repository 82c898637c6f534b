#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "base/channels/event_queue.hpp"
#include "base/channels/latest_value.hpp"
#include "base/music_state.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// What is published after each wake-up: all that drawing needs, taken at one hop.
struct StageState {
    std::array<motion::PoseTrack, motion::Ensemble::kMost> tracks;  ///< one a dancer
    std::size_t dancers = 1;
    MusicState music;
    motion::DancerStatus dancer;       ///< of the first
    std::int64_t published_at_ns = 0;  ///< CLOCK_MONOTONIC

    /// The first dancer's.
    [[nodiscard]] const motion::PoseTrack& track() const noexcept { return tracks[0]; }
};

/// One hop as danced by the first, for tests and benchmarks that need every hop and not only the
/// newest.
struct DancedHop {
    HopIndex hop = 0;
    motion::Pose pose;
};

/// What the motion thread does at each wake-up, without the thread: takes every MusicState in
/// order, advances the dancer, publishes. Late ticks are caught up in order, never skipped.
class MotionStage {
 public:
    /// `states` must outlive this. `record`, if given, gets every danced hop (drops when full).
    MotionStage(motion::Ensemble dancers,
                EventQueue<MusicState>& states,
                EventQueue<DancedHop>* record = nullptr);

    /// Dances what waits. Threads: one, the consumer of `states`. Real-time: yes.
    void tick() noexcept;

    /// The newest stage. Threads: one reader (drawing).
    [[nodiscard]] const StageState& newest() noexcept { return published_.read(); }

    /// Queues a command. Threads: main. False when the queue is full.
    bool command(const motion::DancerCommand& command) noexcept { return commands_.push(command); }

    /// Hops danced so far. Threads: any.
    [[nodiscard]] std::int64_t danced_hops() const noexcept {
        return danced_hops_.load(std::memory_order_acquire);  // pairs with the release in tick()
    }

 private:
    motion::Ensemble dancers_;
    EventQueue<MusicState>& states_;
    EventQueue<DancedHop>* record_;
    EventQueue<motion::DancerCommand> commands_;
    std::unique_ptr<StageState> stage_;  // the ticking thread's own working copy
    LatestValue<StageState> published_;
    std::atomic<std::int64_t> danced_hops_{0};
};

}  // namespace raks::engine
