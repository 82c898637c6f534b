// Hand hold: the joined hands of a couple.
#pragma once

#include <array>
#include <cstddef>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose_track.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How firmly the lead's left hand and the follow's right hand should hold one another in these
/// poses, 0 to 1: less the further they are apart, and not where they would meet close to a
/// shoulder. Threads: any. Real-time: yes.
[[nodiscard]] float wish_to_hold(const Skeleton& skeleton,
                                 const Pose& lead,
                                 const Pose& follow) noexcept RAKS_NONBLOCKING;

/// Moves both hands by the share `hold` of the way to one another, as far as the arms reach
/// comfortably. Threads: any. Real-time: yes.
void join_hands(const Skeleton& skeleton,
                float hold,
                Pose& lead,
                Pose& follow) noexcept RAKS_NONBLOCKING;

/// The hold of a couple over time. A turn sweeps a hand away at 5 m/s, and an arm released as fast
/// as that is thrown (10,000 m/s^3). So the hold is a weighted mean over the wishes of the next and
/// the last 0.2 s; the next ones come from predicted poses. Threads: one owner. Real-time: yes.
class HandHold {
 public:
    /// Nothing known yet.
    HandHold() noexcept;
    /// Forgets the wishes of the last hops.
    void reset() noexcept RAKS_NONBLOCKING;

    /// One hop: joins the hands in the newest final poses and in all predicted ones. The farther
    /// ahead a pose lies, the fewer later wishes it can use.
    void advance(const Skeleton& skeleton,
                 PoseTrack& lead,
                 PoseTrack& follow) noexcept RAKS_NONBLOCKING;

 private:
    static constexpr int kAround = PoseTrack::kPredictedPoses;  // hops on either side

    std::array<float, kAround + 1> weight_{};  // by hops away
    std::array<float, kAround> before_{};  // wishes of the last final hops; hop h in slot h % size
    HopIndex newest_ = -1;                 // latest hop of these
    int known_ = 0;                        // how many of these are valid
};

}  // namespace raks::motion
