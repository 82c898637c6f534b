// Bone aims: which way bones point, in a clip's joints and in the T-pose.
#pragma once

#include <optional>

#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// A direction fixed to a bone, as the file has it and as the T-pose has it; both unit.
struct BoneAim {
    glm::dvec3 in_joint{};   ///< in the frame of the joint
    glm::dvec3 in_t_pose{};  ///< in the T-pose of the mannequin
    bool is_tip = false;     ///< to the end site of a last joint, not to another joint
};

/// Where a bone points: to the next bone of its limb that lies apart from it, of a last joint to
/// its end site. None: nothing below tells (a hand without fingers). A tip goes on as the bone
/// before it does; the foot's goes to the tip of the toes.
[[nodiscard]] std::optional<BoneAim> bone_aim(const PosedBody& body, Bone bone);

/// The second direction of a bone that carries a pair: from right to left of the hips (sockets) and
/// of the trunk's bone that carries the shoulders, from the little to the index finger of a hand.
[[nodiscard]] std::optional<BoneAim> lateral_aim(const PosedBody& body, Bone bone);

/// The shortest rotation between unit vectors; opposite ones: half a turn about the axis across
/// them that is nearest to y, or to x.
[[nodiscard]] glm::dquat shortest_turn(const glm::dvec3& from, const glm::dvec3& to);

}  // namespace raks::motion
