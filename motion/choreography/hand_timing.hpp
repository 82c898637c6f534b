// Hand timing: how far the hands follow the head.
#pragma once

#include "motion/evaluate/body_track.hpp"

namespace raks::motion {

/// How the hands' motion follows the head's. Velocities are compared as vectors, not as speeds: two
/// arms that take turns are never slow together, and a speed, which has no direction, peaks twice
/// in a cycle of the motion, so a delay half a beat too short would fit nearly as well.
struct HandTiming {
    double delay = 0.0;     ///< beats by which the hands follow the head, [-0.5, 0.5]
    double likeness = 0.0;  ///< normalised correlation at that delay, [0, 1]
};

/// The delay d that maximises the sum over both hands and all frames of v_head(t) . v_hand(t + d):
/// the weighted middle of the part around the peak that exceeds 0.8 of it, since the exact position
/// of a flat peak is set by noise. The likeness is the peak divided by the norms of both. Both are
/// 0 where head or hands stand still. `frames_a_beat` >= 2; the track must be longer than a beat.
/// Threads: any. Real-time: no.
[[nodiscard]] HandTiming hand_timing(const BodyTrack& track, double frames_a_beat);

}  // namespace raks::motion
