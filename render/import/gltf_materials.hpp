#pragma once

#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// A texture of a material, of glTF or of an extension: {index, texCoord, KHR_texture_transform}.
/// A field that is not there is no texture. Faults: an index out of `textures`.
/// `model`: gets a warning where texCoord is above 1 (drawn with set 0).
[[nodiscard]] TextureUse read_texture_use(const JsonField& use, Model& model);

}  // namespace raks::render
