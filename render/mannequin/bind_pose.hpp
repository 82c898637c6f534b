#pragma once

#include <array>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// The posture in which the body is modelled: an A-pose. Shoulders and hips are bent by half of
/// what dance needs, and arms, legs and fingers are apart when the surface is extracted.
[[nodiscard]] motion::Pose mannequin_bind_pose() noexcept;

/// Carries points and directions given in the T-pose into the bind pose, bone by bone. Immutable.
class BindFrames {
 public:
    /// Places the skeleton once in the T-pose and once in `bind_pose`, the hips at their rest place
    /// in both. Keeps no reference to either argument.
    BindFrames(const motion::Skeleton& skeleton, const motion::Pose& bind_pose) noexcept;

    /// A point fixed to `bone`: from its T-pose place to its bind-pose place, both in the world,
    /// metres.
    [[nodiscard]] glm::vec3 point(motion::Bone bone, glm::vec3 rest_point) const noexcept {
        return bind_.point(bone, rest_point - rest_.position(bone));
    }
    /// A direction fixed to `bone`, from the T-pose into the bind pose; keeps its length.
    [[nodiscard]] glm::vec3 direction(motion::Bone bone, glm::vec3 rest_direction) const noexcept {
        return bind_.rotation(bone) * rest_direction;
    }
    /// The joint at which `bone` begins, in the world, bind pose.
    [[nodiscard]] glm::vec3 joint(motion::Bone bone) const noexcept { return bind_.position(bone); }
    /// World positions and rotations of all bones in the bind pose.
    [[nodiscard]] const motion::WorldPose& bind() const noexcept { return bind_; }

 private:
    motion::WorldPose rest_;
    motion::WorldPose bind_;
};

}  // namespace raks::render
