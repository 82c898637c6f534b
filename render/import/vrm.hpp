#pragma once

#include "base/expected.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads what VRM says of a figure: Model::character, ModelMaterial::mtoon, and of VRMA files
/// Model::animated_face. `root`: the whole glTF document. Nodes, meshes, materials, textures and
/// skins of `model` are read already; their indices are those of the file. What is bad in a
/// spring, an expression or a texture is left out with a warning; errors: what a figure cannot be
/// without.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> read_character(const JsonField& root, Model& model);

}  // namespace raks::render
