#pragma once

#include "render/import/gltf_accessors.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads animations into `model`, whose nodes and meshes are read already. A channel that cannot be
/// played (another path, times that fall, twice the same target) is left out with a warning.
/// Faults: indices that are not there, values that do not fit the times.
void read_animations(const JsonField& root, GltfAccessors& accessors, Model& model);

}  // namespace raks::render
