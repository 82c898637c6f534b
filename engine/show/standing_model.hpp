#pragma once

#include <optional>

#include "render/avatar/avatar_rig.hpp"
#include "render/model/model.hpp"

namespace raks::engine {

/// Puts the nodes of a model whose bones are known where its body stands (render::stand_up):
/// facing +z, each part below the bone that carries it, bound as its skin was. Returns its size and
/// T-pose for the rig. `height`: as for stand_up. Threads: any. Real-time: no.
[[nodiscard]] render::RigOptions stand_model(render::Model& model, std::optional<float> height);

/// Puts a model without a body on the floor in the middle, as large as a person: its unit may be
/// any. Returns the size for the rig. Threads: any. Real-time: no.
[[nodiscard]] render::RigOptions stand_thing(render::Model& model);

}  // namespace raks::engine
