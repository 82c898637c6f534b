// Elbow: where an arm has it, while hand and shoulder stay.
#pragma once

#include "base/realtime.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// Turns a limb about the line from its root to its end by the share [0, 1] of the way on which its
/// middle joint comes to lie towards `aim` (world, seen from the root's line; of any length). The
/// end stays where it is and turns with the limb. A middle joint on the other side of the line
/// stays, too, as neither way round is the shorter one. Threads: any. Real-time: yes.
void turn_elbow(const Skeleton& skeleton,
                const Limb& limb,
                const glm::vec3& aim,
                float share,
                Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
