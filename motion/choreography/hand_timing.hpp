#pragma once

#include "motion/evaluate/body_track.hpp"

namespace raks::motion {

/// How the hands go with the head. Where they go is compared, not how fast: two arms that take
/// turns are never slow together, and speeds, which have no direction, come round twice as often as
/// the movement: they fit half a beat too early nearly as well.
struct HandTiming {
    double delay = 0.0;     ///< beats by which the hands follow the head, [-0.5, 0.5]
    double likeness = 0.0;  ///< 0: they have nothing to do with it; 1: they go as it goes
};

/// The delay d at which the sum over both hands and all frames of v_head(t) . v_hand(t + d) is
/// greatest: the middle of what is over 0.8 of its peak, since the very peak of a flat one lies
/// wherever noise has it. The likeness is that peak by the sizes of both. Both 0 where one of them
/// stands. `frames_a_beat` >= 2; the track is longer than a beat.
/// Threads: any. Real-time: no.
[[nodiscard]] HandTiming hand_timing(const BodyTrack& track, double frames_a_beat);

}  // namespace raks::motion
