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

/// Moves what was said in the T-pose into the bind pose, bone by bone.
class BindFrames {
 public:
    BindFrames(const motion::Skeleton& skeleton, const motion::Pose& bind_pose) noexcept;

    /// A point riding on `bone`, from T-pose to bind pose, both in the world.
    [[nodiscard]] glm::vec3 point(motion::Bone bone, glm::vec3 rest_point) const noexcept {
        return bind_.point(bone, rest_point - rest_.position(bone));
    }
    /// A direction riding on `bone`.
    [[nodiscard]] glm::vec3 direction(motion::Bone bone, glm::vec3 rest_direction) const noexcept {
        return bind_.rotation(bone) * rest_direction;
    }
    [[nodiscard]] glm::vec3 joint(motion::Bone bone) const noexcept { return bind_.position(bone); }
    [[nodiscard]] const motion::WorldPose& bind() const noexcept { return bind_; }

 private:
    motion::WorldPose rest_;
    motion::WorldPose bind_;
};

}  // namespace raks::render
