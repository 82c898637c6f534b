// Two-bone inverse kinematics of arms and legs.
#pragma once

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Longest reach of a limb that keeps its knee or elbow from locking, as a share of its length.
inline constexpr float kLongestReach = 0.997F;

/// Shortest rotation that turns direction `from` to direction `to`, both of any length but 0.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat rotation_between(const glm::vec3& from, const glm::vec3& to) noexcept;

/// Two bones in a row and what hangs on them: thigh, shin and foot, or arm, forearm and hand.
struct Limb {
    Bone upper = Bone::left_upper_leg;  ///< thigh or upper arm
    Bone lower = Bone::left_lower_leg;  ///< shin or forearm
    Bone end = Bone::left_foot;         ///< foot or hand
    glm::vec3 root{};                   ///< joint of the upper bone in the world
    glm::quat parent{kNoRotation};      ///< world rotation of the parent bone
    glm::vec3 ahead{};  ///< direction in which the middle joint leaves a straight limb, world
};

/// One arm of a pose; from a straight arm the elbow goes backward, as the upper arm is turned.
/// Threads: any. Real-time: yes.
[[nodiscard]] Limb arm_of(const WorldPose& world, Side side) noexcept;

/// Turns both bones so that the end's joint reaches `target` in the world, as far as they do; the
/// middle joint keeps its side of the line from root to end. Returns the lower bone's new rotation
/// in the world. Threads: any. Real-time: yes.
glm::quat solve_limb(const Skeleton& skeleton,
                     const Limb& limb,
                     const glm::vec3& target,
                     Pose& pose) noexcept;

}  // namespace raks::motion
