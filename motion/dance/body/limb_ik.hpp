// Two-bone inverse kinematics of arms and legs.
#pragma once

#include <array>

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Longest reach of a limb that keeps its knee or elbow from locking, as a share of its length.
inline constexpr float kLongestReach = 0.997F;

/// Shortest rotation that turns direction `from` to direction `to`, both of any length but 0.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat rotation_between(const glm::vec3& from,
                                         const glm::vec3& to) noexcept RAKS_NONBLOCKING;

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
[[nodiscard]] Limb arm_of(const WorldPose& world, Side side) noexcept RAKS_NONBLOCKING;

/// Turns both bones so that the end's joint reaches `target` in the world, as far as they do; the
/// middle joint keeps its side of the line from root to end. Returns the lower bone's new rotation
/// in the world. Threads: any. Real-time: yes.
glm::quat solve_limb(const Skeleton& skeleton,
                     const Limb& limb,
                     const glm::vec3& target,
                     Pose& pose) noexcept RAKS_NONBLOCKING;

// Leg inverse kinematics, and where the sole is.

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
                                         const glm::quat& rotation) noexcept RAKS_NONBLOCKING;

/// Where a foot is, in the world.
struct FootPlace {
    glm::vec3 pivot{};                ///< the point about which it turns while it is planted
    glm::quat rotation{kNoRotation};  ///< of the foot bone
};
/// The place of the foot of one side. Threads: any. Real-time: yes.
[[nodiscard]] FootPlace foot_place(const Skeleton& skeleton,
                                   const WorldPose& world,
                                   Side side) noexcept RAKS_NONBLOCKING;

/// The heading of a foot's toes, radians about up. Threads: any. Real-time: yes.
[[nodiscard]] float foot_heading(const glm::quat& rotation) noexcept RAKS_NONBLOCKING;

/// Turns thigh, shin and foot of one side so that the ankle reaches the target (as far as the leg
/// does) and the foot has its rotation. The knee keeps its direction about the line from hip to
/// ankle. Hips and the rest of the body stay.
/// Threads: any. Real-time: yes.
void solve_leg(const Skeleton& skeleton,
               Side side,
               const FootTarget& target,
               Pose& pose) noexcept RAKS_NONBLOCKING;

/// Lowers the hips, softly, until both feet are in reach; the legs are to be solved afterwards.
/// `ankles`: where the feet shall be. Threads: any. Real-time: yes.
void lower_to_reach(const Skeleton& skeleton,
                    const std::array<glm::vec3, 2>& ankles,
                    Pose& pose) noexcept RAKS_NONBLOCKING;

/// Solves both legs of `pose` so that its feet are where `other` has them, but not below the floor.
/// The hips are lowered where a leg is too short for that. Threads: any. Real-time: yes.
void put_feet_as(const Skeleton& skeleton, const Pose& other, Pose& pose) noexcept RAKS_NONBLOCKING;

/// Lifts each foot whose sole is below the floor onto it, by the leg alone.
/// Threads: any. Real-time: yes.
void lift_feet(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING;

/// Lowest point of a sole under the ankle, when the foot has this rotation in the world and the
/// toes theirs in the foot's frame; metres, negative. Threads: any. Real-time: yes.
[[nodiscard]] float lowest_of_sole(const Skeleton& skeleton,
                                   Side side,
                                   const glm::quat& foot_rotation,
                                   const glm::quat& toes_rotation) noexcept RAKS_NONBLOCKING;

/// Length of thigh and shin together; metres.
[[nodiscard]] float leg_length(const Skeleton& skeleton) noexcept;

}  // namespace raks::motion
