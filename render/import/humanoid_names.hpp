// Bones by the names of nodes.
#pragma once

#include <span>

#include "render/model/model.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// The bones that names give away: VRM, Unity, Mixamo, Biped, Rigify, Daz, MikuMikuDance and all
/// that is built like them (see bone_words.hpp); what no name tells is left open. Names alone do
/// not decide: hips carry legs and trunk, "leg" is the upper one where a knee is named, the trunk
/// is counted from hips to arms. `places`: of all nodes, in a standing pose.
[[nodiscard]] HumanoidMap map_by_names(const Model& model, std::span<const glm::vec3> places);

}  // namespace raks::render
