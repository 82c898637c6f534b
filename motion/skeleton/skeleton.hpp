// Skeleton: bone lengths and girth, and forward kinematics.
#pragma once

#include <array>
#include <span>

#include "base/realtime.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// How thick a body is, for keeping its hands out of it (body_capsules.hpp); metres. The values
/// here are the mannequin's.
struct Girth {
    float flank = 0.06F;         ///< from the trunk's middle to that of either flank
    float trunk = 0.085F;        ///< radius of a flank: half the trunk's depth
    float trunk_ahead = 0.0F;    ///< the trunk's middle before the hips' joint
    float chest_height = 0.05F;  ///< the trunk's upper end over the upper chest's joint
    float head = 0.08F;          ///< radius of the head
    float head_height = 0.14F;   ///< middle of the head over its joint
    float thigh = 0.07F;         ///< radius
    float shin = 0.05F;          ///< radius
    float forearm = 0.03F;       ///< radius
    float hand = 0.02F;          ///< half its thickness: a palm may rest on the body

    friend bool operator==(const Girth&, const Girth&) = default;
};

/// Bone lengths of one humanoid in T-pose, in metres. All rest rotations are identity, so a bone's
/// frame has the world's axes in T-pose.
struct Skeleton {
    /// Vector from the parent bone's joint to this bone's joint; for the hips their place in the
    /// world (its y is the standing height of the hips).
    std::array<glm::vec3, kBoneCount> offsets{};
    /// Ball of the foot on the sole, in the left foot bone's frame in T-pose (mirrored for the
    /// right). Its y is the sole: rest height of the foot + y = 0, the floor.
    glm::vec3 ball{};
    glm::vec3 toe_tip{};     ///< tip of the toes, likewise
    glm::vec3 heel{};        ///< back of the heel, likewise
    float sole_half = 0.0F;  ///< half the width of the soles; metres
    Girth girth;             ///< of its flesh and clothes
    /// How large the body is shown against this one, whose dances are solved for a common size;
    /// > 0. What two bodies do with one another is done at these sizes.
    float shown_size = 1.0F;

    /// Standing height of the hips; metres.
    [[nodiscard]] float hips_height() const noexcept { return offsets[0].y; }

    friend bool operator==(const Skeleton&, const Skeleton&) = default;
};

/// The built-in mannequin's skeleton: 1.714 m tall.
[[nodiscard]] const Skeleton& mannequin_skeleton() noexcept;

/// The same body `factor` times as large.
[[nodiscard]] Skeleton scaled(Skeleton skeleton, float factor) noexcept;

/// Place and orientation of every bone in the world for one pose.
struct WorldPose {
    std::array<glm::vec3, kBoneCount> positions{};  ///< of the joints, by bone; metres
    std::array<glm::quat, kBoneCount> rotations{};  ///< by bone

    /// Place of a bone's joint.
    [[nodiscard]] const glm::vec3& position(Bone bone) const noexcept {
        return positions[index_of(bone)];
    }
    /// Orientation of a bone.
    [[nodiscard]] const glm::quat& rotation(Bone bone) const noexcept {
        return rotations[index_of(bone)];
    }
    /// World place of a point fixed to a bone.
    [[nodiscard]] glm::vec3 point(Bone bone, glm::vec3 local) const noexcept {
        return position(bone) + rotation(bone) * local;
    }
};

/// Forward kinematics. Threads: any. Real-time: yes (52 products).
[[nodiscard]] WorldPose world_pose(const Skeleton& skeleton,
                                   const Pose& pose) noexcept RAKS_NONBLOCKING;
/// The same of the body alone: of the fingers only the first two bones of the middle ones, which
/// say where a hand ends; all others stay at zero. What dances needs no more, and it costs half.
/// Threads: any. Real-time: yes (26 products).
[[nodiscard]] WorldPose world_body(const Skeleton& skeleton,
                                   const Pose& pose) noexcept RAKS_NONBLOCKING;

/// A point fixed to the foot's bone (ball or heel of the skeleton) on one side, in the world.
[[nodiscard]] glm::vec3 foot_point(const WorldPose& world,
                                   Side side,
                                   glm::vec3 left_local) noexcept RAKS_NONBLOCKING;

/// The tip of the toes of one side, which bend by the ball of the foot, in the world.
[[nodiscard]] glm::vec3 toe_tip(const Skeleton& skeleton,
                                const WorldPose& world,
                                Side side) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
