// T-pose check: which limbs of a file lie as in our T-pose when no joint is rotated.
#pragma once

#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

/// Limbs whose rest pose is a T-pose's.
struct TPosedLimbs {
    bool trunk = false;  ///< with neck and head
    bool legs = false;   ///< both
    bool arms = false;   ///< both, with shoulders and fingers

    /// Whether all are.
    [[nodiscard]] bool are_all() const { return trunk && legs && arms; }
    /// Whether a bone belongs to one of them.
    [[nodiscard]] bool has(Bone bone) const;
};

/// Looks at the joints' places without rotation, turned by `figure` from the file's axes to ours.
/// Bounds: a leg 10 degrees from straight down, with the toes ahead; an arm 12 from straight
/// sideways; the trunk's bones 30 from straight up. Rest poses of real files (DAZ bends the
/// forearms by 17 degrees, CMU spreads the legs by 20) fall on the right side.
[[nodiscard]] TPosedLimbs t_posed_limbs(const PosedBody& body, const glm::dquat& figure);

}  // namespace raks::motion
