// Isolation: a part of the body stays where it is in the room while another one moves.
#pragma once

#include "base/realtime.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Bends the spine so that a part stays over the place on the floor where it is in the posture
/// `middle`, as far as a spine bends; arms and head keep their directions, hips and legs stay.
/// Threads: any. Real-time: yes.
void keep_still(const Skeleton& skeleton,
                StillPart part,
                const Pose& middle,
                Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
