// Which nodes of a model are the bones of its figure.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Those of a figure of rigid parts (HumanoidMap::is_of_parts): a limb may be one part, and trunk
/// and head may be one.
inline constexpr std::array<motion::Bone, 6> kRequiredParts = {
    motion::Bone::hips,
    motion::Bone::spine,
    motion::Bone::left_upper_leg,
    motion::Bone::left_upper_arm,
    motion::Bone::right_upper_leg,
    motion::Bone::right_upper_arm,
};

/// Those of a figure with a skin: arms may end without hands, the trunk may be one joint.
inline constexpr std::array<motion::Bone, 12> kRequiredJoints = {
    motion::Bone::hips,
    motion::Bone::head,
    motion::Bone::left_upper_leg,
    motion::Bone::left_lower_leg,
    motion::Bone::left_foot,
    motion::Bone::left_upper_arm,
    motion::Bone::left_lower_arm,
    motion::Bone::right_upper_leg,
    motion::Bone::right_lower_leg,
    motion::Bone::right_foot,
    motion::Bone::right_upper_arm,
    motion::Bone::right_lower_arm,
};

/// The bones without which this figure does not dance.
[[nodiscard]] std::span<const motion::Bone> required_bones(const HumanoidMap& humanoid) noexcept;

/// Names of the bones among `needed` that a map lacks, with commas; empty: it has them all.
[[nodiscard]] std::string missing_bones(const HumanoidMap& humanoid,
                                        std::span<const motion::Bone> needed);
/// The same of those without which it does not dance.
[[nodiscard]] std::string missing_bones(const HumanoidMap& humanoid);

/// How a bone was found, in words: "named in the file".
[[nodiscard]] std::string_view words_of(BoneReason reason) noexcept;

/// What map_humanoid finds, also where it is no whole figure: sides as they are named,
/// `missing_bones` may be left. Warnings as there. Threads: workers. Real-time: no.
[[nodiscard]] HumanoidMap look_for_bones(Model& model, const BoneLabels* labels = nullptr);

/// Finds the bones of a model that does not name them itself, and writes them to
/// Model::character.humanoid: by `labels` where they are given; else by names, as far as tree and
/// flesh do not speak against them (limb_faults.hpp), and what those leave open by shape; where no
/// figure comes of it, by how the model's first clip moves (motion/skeleton/body/joint_finder.hpp).
/// A limb whose names are wrong is taken by shape; where the shape knows no better, its bones get a
/// confidence below 0.7; a warning says both. A left that lies right is swapped, with a warning. A
/// model that names its bones (VRM, VRMA) is left as it is. A label that names no node, or one of
/// two bones, is a warning; the others hold.
/// Errors: required bones are missing (the line lists them), a figure that is not upright (four
/// legs).
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> map_humanoid(Model& model, const BoneLabels* labels = nullptr);

}  // namespace raks::render
