// Painted triangles as parts of one colour. For render/mannequin alone.
#pragma once

#include <map>
#include <span>

#include "render/mannequin/painted_mesh.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The triangles of a primitive by their colour, with the vertices and morph targets that they
/// need; without texture coordinates. `paints`: by triangle. The material is the primitive's.
[[nodiscard]] std::map<Paint, ModelPrimitive> paint_parts(const ModelPrimitive& primitive,
                                                          std::span<const Paint> paints);

}  // namespace raks::render
