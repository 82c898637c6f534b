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
    Bone upper = Bone::left_upper_leg;
    Bone lower = Bone::left_lower_leg;
    Bone end = Bone::left_foot;
    glm::vec3 root{};               ///< joint of the upper bone in the world
    glm::quat parent{kNoRotation};  ///< rotation in the world of the bone that it hangs on
    glm::vec3 ahead{};              ///< where the middle joint goes from a straight limb, world
};

/// An arm, its hand at the end; from a straight one the elbow goes behind, as the upper arm is
/// turned. Threads: any. Real-time: yes.
[[nodiscard]] Limb arm_of(const WorldPose& world, Side side) noexcept;

/// Turns both bones so that the end's joint reaches `target` in the world, as far as they do; the
/// middle joint keeps its direction about the line from root to end. Returns the lower bone's
/// rotation in the world then. Threads: any. Real-time: yes.
glm::quat solve_limb(const Skeleton& skeleton,
                     const Limb& limb,
                     const glm::vec3& target,
                     Pose& pose) noexcept;

}  // namespace raks::motion
