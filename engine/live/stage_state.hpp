// What the motion thread shows of the dancers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/channels/latest_value.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/pose_track.hpp"

#include <glm/vec2.hpp>

namespace raks::engine {

/// What is published after each wake-up: all that a picture needs, taken at one hop.
struct StageState {
    std::array<motion::PoseTrack, motion::Ensemble::kMost> tracks;  ///< one a dancer
    std::size_t dancers = 1;  ///< how many of the tracks are in use; others mean nothing
    /// Where each of them stands when not carried away by the dance (motion::DancerPart::place).
    std::array<glm::vec2, motion::Ensemble::kMost> places{};
    MusicState music;                  ///< the state that was danced to last
    motion::DancerStatus dancer;       ///< of the first
    std::int64_t published_at_ns = 0;  ///< CLOCK_MONOTONIC; 0: nothing was danced yet
    /// The last states danced to, that of hop h at h % kRecent: as many as there are final poses,
    /// so that a reader who looks seldom can go through every hop.
    static constexpr std::size_t kRecent = motion::PoseTrack::kFinalPoses;
    std::array<MusicState, kRecent> recent;

    /// The state of a hop, of which the tracks hold the final pose; null: it is none of the last.
    [[nodiscard]] const MusicState* state_of(HopIndex hop) const noexcept {
        const MusicState& state = recent[static_cast<std::size_t>(hop) % kRecent];
        return published_at_ns != 0 && state.hop == hop ? &state : nullptr;
    }
    /// Takes what is in use of another stage. Real-time: yes.
    void copy_used(const StageState& from) noexcept RAKS_NONBLOCKING;
    /// The first dancer's.
    [[nodiscard]] const motion::PoseTrack& track() const noexcept { return tracks[0]; }
};

/// The channel to one reader: it gets the newest stage at its own pace. The motion thread writes.
using StageChannel = LatestValue<StageState>;

}  // namespace raks::engine
