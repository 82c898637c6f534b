// Bone labelling: which nodes of a model a person says are its bones, as a value with its history.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/history.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// Labels in the order of the bones, one a bone and one a node; and what was taken back.
using BoneLabelling = History<std::vector<render::BoneLabel>>;

/// A labelling that begins with these labels, which count as saved. Of two for a bone or for a node
/// the former holds.
[[nodiscard]] BoneLabelling bone_labelling(const std::vector<render::BoneLabel>& labels);

/// A step: `node` is `bone`, and no other bone any more. Errors: the node's name says no other
/// labels file which one is meant (it has none, another node has it, or it is no UTF-8).
[[nodiscard]] Expected<void> label_bone(const render::Model& model,
                                        motion::Bone bone,
                                        int node,
                                        BoneLabelling& labelling);

/// A step: nothing is said of `bone` any more. None where nothing was said.
void unlabel_bone(motion::Bone bone, BoneLabelling& labelling);

/// A step: the label of `bone` says that it points along `axis` of its node at rest (a unit vector
/// of one coordinate); 0: it does not say so. None where nothing is said of `bone`.
void set_rest_axis(motion::Bone bone, const glm::vec3& axis, BoneLabelling& labelling);

/// What a person is offered after `axis`: none, x, y, z, -x, -y, -z, and none again.
[[nodiscard]] glm::vec3 next_rest_axis(const glm::vec3& axis) noexcept;

/// Writes the labels as a label file, whole or not at all; without labels the file is removed.
/// They count as saved then. Errors: the system's. Threads: one.
[[nodiscard]] Expected<void> save_labels(const std::filesystem::path& file,
                                         BoneLabelling& labelling);

}  // namespace raks::engine
