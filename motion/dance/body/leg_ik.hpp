// Leg inverse kinematics, and where the sole is.
#pragma once

#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Target of a foot, in the world.
struct FootTarget {
    glm::vec3 ankle{};                ///< place of the ankle joint; metres
    glm::quat rotation{kNoRotation};  ///< of the foot bone, in the world
};

/// Vector from the ankle to the point about which a planted foot of this rotation turns, world:
/// between the ball's joint and the tip of the toes as they lie flat while the heel is up. Threads:
/// any. Real-time: yes.
[[nodiscard]] glm::vec3 pivot_from_ankle(const Skeleton& skeleton,
                                         Side side,
                                         const glm::quat& rotation) noexcept;

/// Turns thigh, shin and foot of one side so that the ankle reaches the target (as far as the leg
/// does) and the foot has its rotation. The knee keeps its direction about the line from hip to
/// ankle. Hips and the rest of the body stay.
/// Threads: any. Real-time: yes.
void solve_leg(const Skeleton& skeleton, Side side, const FootTarget& target, Pose& pose) noexcept;

/// Lifts each foot whose sole is below the floor onto it, by the leg alone.
/// Threads: any. Real-time: yes.
void lift_feet(const Skeleton& skeleton, Pose& pose) noexcept;

/// Lowest point of a sole under the ankle, when the foot has this rotation in the world and the
/// toes theirs in the foot's frame; metres, negative. Threads: any. Real-time: yes.
[[nodiscard]] float lowest_of_sole(const Skeleton& skeleton,
                                   Side side,
                                   const glm::quat& foot_rotation,
                                   const glm::quat& toes_rotation) noexcept;

/// Length of thigh and shin together; metres.
[[nodiscard]] float leg_length(const Skeleton& skeleton) noexcept;

}  // namespace raks::motion
