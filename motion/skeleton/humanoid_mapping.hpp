// Humanoid mapping: which joints of a recorded skeleton are which bones.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// Which joint of a clip moves which humanoid bone, as find_joints (body/joint_finder.hpp) tells.
/// Joints without a bone (helpers like lButtock or LHipJoint) are folded into the next bone below
/// them.
struct HumanoidMapping {
    std::array<std::optional<std::size_t>, kBoneCount> joints{};  ///< by bone

    /// The joint of a bone; none: the clip has none.
    [[nodiscard]] std::optional<std::size_t> joint(Bone bone) const noexcept {
        return joints[index_of(bone)];
    }
};

/// The nearest bone above `bone` that a clip has; none above the hips.
[[nodiscard]] std::optional<Bone> mapped_parent(const HumanoidMapping& mapping, Bone bone);

}  // namespace raks::motion
