// Bone twist: what the motion says about the turn of a joint's frame about its bone.
#pragma once

#include <optional>

#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// The part of a rotation that turns about `axis` (unit); radians, -pi to pi.
[[nodiscard]] double twist_of(const glm::dquat& rotation, const glm::dvec3& axis);

/// The posed frames of a body with y up. A "rest" is the rotation from a joint's frame to that of
/// the T-pose. The body must outlive it. Threads: workers. Real-time: no.
class TurnedBody {
 public:
    /// `upright`: turns the world of the file to y up.
    TurnedBody(const PosedBody& body, const glm::dquat& upright)
        : body_(&body), upright_(upright) {}

    /// Mean over the frames of the bone's joint against the bone above in the T-pose's frame: the
    /// rest that makes the bone move least against it.
    [[nodiscard]] glm::dquat mean_against(Bone above,
                                          const glm::dquat& rest_above,
                                          Bone bone) const;

    /// For bones of arms and legs: the twist that lays the hinge of elbow or knee across the bone
    /// as in the T-pose, added to the rest `straight`; `direction`: of the bone in the T-pose.
    /// None: other bones, and limbs that are never bent.
    [[nodiscard]] std::optional<double> hinge_twist(Bone bone,
                                                    const glm::dquat& straight,
                                                    const glm::dvec3& direction) const;

    /// How far the bone's face (+z in the T-pose) looks up with such a rest; median, radians.
    [[nodiscard]] double lean(Bone bone, const glm::dquat& rest) const;

 private:
    [[nodiscard]] glm::dquat turn(std::size_t i, Bone bone) const {
        return upright_ * body_->world(i).rotations[body_->joint(bone)];
    }

    const PosedBody* body_;
    glm::dquat upright_;
};

}  // namespace raks::motion
