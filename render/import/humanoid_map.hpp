// Which nodes of a model are the bones of its figure.
#pragma once

#include <array>
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

/// Names of the required bones that a map lacks, with commas; empty: it has them all.
[[nodiscard]] std::string missing_bones(const HumanoidMap& humanoid);

/// How a bone was found, in words: "named in the file".
[[nodiscard]] std::string_view words_of(BoneReason reason) noexcept;

/// What map_humanoid finds, also where it is no whole figure: sides as they are named,
/// `missing_bones` may be left. Warnings as there. Threads: workers. Real-time: no.
[[nodiscard]] HumanoidMap look_for_bones(Model& model, const BoneLabels* labels = nullptr);

/// Finds the bones of a model that does not name them itself, and writes them to
/// Model::character.humanoid: by `labels` where they are given, else by names, and what those
/// leave open by shape. Checked against the places of the bones always: a left that lies right is
/// swapped, with a warning. A model that names its bones (VRM, VRMA) is left as it is. A label that
/// names no node, or one of two bones, is a warning; the others hold.
/// Errors: required bones are missing (the line lists them), a figure that is not upright (four
/// legs).
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> map_humanoid(Model& model, const BoneLabels* labels = nullptr);

}  // namespace raks::render
