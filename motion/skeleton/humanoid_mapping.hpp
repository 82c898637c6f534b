// Humanoid mapping: which joints of a recorded skeleton are which bones.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// Which joint of a clip moves which humanoid bone. Joints without a bone (helpers like lButtock
/// or LHipJoint) are folded into the next bone below them.
struct HumanoidMapping {
    std::array<std::optional<std::size_t>, kBoneCount> joints{};  ///< by bone

    /// The joint of a bone; none: the clip has none.
    [[nodiscard]] std::optional<std::size_t> joint(Bone bone) const noexcept {
        return joints[index_of(bone)];
    }
};

/// The nearest bone above `bone` that a clip has; none above the hips.
[[nodiscard]] std::optional<Bone> mapped_parent(const HumanoidMapping& mapping, Bone bone);

/// The mapping that find_joints (body/joint_finder.hpp) finds. Errors: those of find_joints.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<HumanoidMapping> map_humanoid(const MotionClip& clip);

}  // namespace raks::motion
