// Limb faults: what the picture of a model says against the bones of a limb.
#pragma once

#include <array>
#include <span>
#include <string>

#include "render/import/joint_shape.hpp"
#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>

namespace raks::render {

/// The three bones of a limb. The last may be missing.
struct CheckedLimb {
    motion::Bone upper;
    motion::Bone lower;
    motion::Bone last;
    const char* name;  ///< "left arm"
};

inline constexpr std::array<CheckedLimb, 4> kCheckedLimbs = {{
    {motion::Bone::left_upper_arm,
     motion::Bone::left_lower_arm,
     motion::Bone::left_hand,
     "left arm"},
    {motion::Bone::right_upper_arm,
     motion::Bone::right_lower_arm,
     motion::Bone::right_hand,
     "right arm"},
    {motion::Bone::left_upper_leg,
     motion::Bone::left_lower_leg,
     motion::Bone::left_foot,
     "left leg"},
    {motion::Bone::right_upper_leg,
     motion::Bone::right_lower_leg,
     motion::Bone::right_foot,
     "right leg"},
}};

/// What speaks against the bones of a limb, in words that name the node: its lower bone does not
/// hang on the upper one, one of them moves nothing of the skin, one is three times as long as the
/// other, an upper arm begins on the middle line of the chest. Empty: nothing does, or upper or
/// lower bone is missing. `world`, `flesh`: of all nodes, standing.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string limb_fault(const Model& model,
                                     const HumanoidMap& humanoid,
                                     const CheckedLimb& limb,
                                     std::span<const glm::mat4> world,
                                     const NodeFlesh& flesh);

}  // namespace raks::render
