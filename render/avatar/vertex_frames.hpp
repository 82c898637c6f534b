// Normals and tangents for meshes that bring none.
#pragma once

#include <span>
#include <vector>

#include "render/model/model.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// Unit normals by vertex: the mean of its triangles' normals, each by its area. Vertices at one
/// place share theirs, so that seams of the texture do not show.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const ModelPrimitive& primitive);

/// Unit tangents along u by vertex, with the side of the bitangent in w; empty where there are no
/// texture coordinates.
[[nodiscard]] std::vector<glm::vec4> made_tangents(const ModelPrimitive& primitive,
                                                   std::span<const glm::vec3> normals);

}  // namespace raks::render
