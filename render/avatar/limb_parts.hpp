// Limbs that are one rigid part: where their joints would be, and how the part follows them.
#pragma once

#include <array>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/body_measure.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::render {

/// A limb's three bones.
struct LimbBones {
    motion::Bone upper;
    motion::Bone lower;
    motion::Bone end;  ///< hand, foot
};

inline constexpr std::array<LimbBones, 4> kLimbs = {{
    {motion::Bone::left_upper_leg, motion::Bone::left_lower_leg, motion::Bone::left_foot},
    {motion::Bone::left_upper_arm, motion::Bone::left_lower_arm, motion::Bone::left_hand},
    {motion::Bone::right_upper_leg, motion::Bone::right_lower_leg, motion::Bone::right_foot},
    {motion::Bone::right_upper_arm, motion::Bone::right_lower_arm, motion::Bone::right_hand},
}};

/// Whether a limb is one part: it has an upper bone and no other.
[[nodiscard]] bool is_one_part(const LimbBones& limb,
                               const std::array<bool, motion::kBoneCount>& is_there) noexcept;

/// Gives limbs that are one part a knee or an elbow in their middle and an ankle or a wrist near
/// their end, by their flesh in the T-pose, arms without hands a wrist in the flesh of the forearm,
/// and a head where trunk and head are one; the flesh is then of these bones. So a dance can be
/// solved for them. Threads: any. Real-time: no.
void add_lacking_joints(std::vector<FleshPoint>& flesh, BonePlaces& bones);

/// How a limb that is one part turns against its upper bone, so that its end lies in the direction
/// in which a limb of two equal parts has it. Threads: any. Real-time: yes.
[[nodiscard]] glm::quat swing_of_part(const LimbBones& limb, const motion::Pose& pose) noexcept;

}  // namespace raks::render
