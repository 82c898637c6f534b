#pragma once

#include <array>
#include <cstddef>

#include "base/time.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How firmly the lead's left hand and the follow's right would hold one another as they are, 0 to
/// 1: they let go the further apart they are, and where they would meet at a shoulder.
/// Threads: any. Real-time: yes.
[[nodiscard]] float wish_to_hold(const Skeleton& skeleton,
                                 const Pose& lead,
                                 const Pose& follow) noexcept;

/// Brings both hands that share of the way to one another, as far as the arms like to reach.
/// Threads: any. Real-time: yes.
void join_hands(const Skeleton& skeleton, float hold, Pose& lead, Pose& follow) noexcept;

/// The hands of a couple over time. A turn sweeps a hand away at 5 m/s: let go as fast as that, an
/// arm is thrown (10,000 m/s^3). So the hold is a mean over what the next and the last 0.2 s wish:
/// the next are predicted poses. Threads: one owner. Real-time: yes.
class HandHold {
 public:
    HandHold() noexcept;
    void reset() noexcept;

    /// One hop: joins the hands in the newest final poses and all predicted ones, which know the
    /// less of what comes the further ahead they are.
    void advance(const Skeleton& skeleton, PoseTrack& lead, PoseTrack& follow) noexcept;

 private:
    static constexpr int kAround = PoseTrack::kPredictedPoses;  // hops on either side

    std::array<float, kAround + 1> weight_{};  // by hops away
    std::array<float, kAround> before_{};  // wishes of the last final hops; hop h in slot h % size
    HopIndex newest_ = -1;                 // hop of the latest of them
    int known_ = 0;                        // how many
};

}  // namespace raks::motion
