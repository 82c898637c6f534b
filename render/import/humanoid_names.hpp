// Bones by the names of nodes.
#pragma once

#include "render/model/model.hpp"

namespace raks::render {

/// The bones that names give away: VRM, Unity, Mixamo, Biped, Rigify, Daz, MikuMikuDance and all
/// that is built like them (see bone_words.hpp); what no name tells is left open. Names alone do
/// not decide: hips carry legs and trunk, "leg" is the upper one where a knee is named, the trunk
/// is counted from hips to arms.
[[nodiscard]] HumanoidMap map_by_names(const Model& model);

}  // namespace raks::render
