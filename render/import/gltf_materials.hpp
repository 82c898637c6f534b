#pragma once

#include "render/import/gltf_buffers.hpp"
#include "render/import/json_field.hpp"
#include "render/import/side_files.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads images, textures with their samplers, and materials into `model`, as many as the file
/// has. An image that cannot be drawn is left out with a warning; a material that names a texture
/// that is not there is a fault. Extensions: EXT_texture_webp, KHR_texture_transform,
/// KHR_materials_unlit, KHR_materials_emissive_strength.
void read_materials(const JsonField& root,
                    GltfBuffers& buffers,
                    const SideFiles& side,
                    ImportBudget& budget,
                    Model& model);

/// A texture of a material, of glTF or of an extension: {index, texCoord, KHR_texture_transform}.
/// A field that is not there is no texture. Faults: an index out of Model::textures. Warns where
/// texCoord is above 1 (drawn with set 0).
[[nodiscard]] TextureUse read_texture_use(const JsonField& use, Model& model);

}  // namespace raks::render
