#include "render/avatar/vertex_frames.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

/// A unit vector; `other` where the length is 0.
glm::vec3 unit(glm::vec3 v, glm::vec3 other) noexcept {
    const float length = glm::length(v);
    return length > 0.0F && std::isfinite(length) ? v / length : other;
}

glm::vec3 any_across(glm::vec3 normal) noexcept {
    const glm::vec3 axis =
        std::abs(normal.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    return glm::normalize(glm::cross(normal, axis));
}

/// The directions of growing u and v over one triangle, not of unit length.
struct Directions {
    glm::vec3 along_u{0.0F};
    glm::vec3 along_v{0.0F};
};

Directions directions(const ModelPrimitive& primitive,
                      const std::array<std::uint32_t, 3>& corner) noexcept {
    const auto& p = primitive.positions;
    const auto& uv = primitive.uv[0];
    const glm::vec3 e1 = p[corner[1]] - p[corner[0]];
    const glm::vec3 e2 = p[corner[2]] - p[corner[0]];
    const glm::vec2 d1 = uv[corner[1]] - uv[corner[0]];
    const glm::vec2 d2 = uv[corner[2]] - uv[corner[0]];
    const float area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0F) {
        return {};
    }
    // Only the sign of the area: large triangles count for more.
    const float side = area > 0.0F ? 1.0F : -1.0F;
    return {side * (d2.y * e1 - d1.y * e2), side * (d1.x * e2 - d2.x * e1)};
}

}  // namespace

std::vector<glm::vec3> smooth_normals(const ModelPrimitive& primitive) {
    std::map<std::array<float, 3>, glm::vec3> sums;
    const auto& p = primitive.positions;
    const auto key = [&](std::uint32_t i) { return std::array<float, 3>{p[i].x, p[i].y, p[i].z}; };
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corner = {
            primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
        const glm::vec3 normal =
            glm::cross(p[corner[1]] - p[corner[0]], p[corner[2]] - p[corner[0]]);
        for (const std::uint32_t vertex : corner) {
            sums[key(vertex)] += normal;
        }
    }
    std::vector<glm::vec3> normals;
    for (std::uint32_t i = 0; i < p.size(); ++i) {
        normals.push_back(unit(sums[key(i)], {0.0F, 1.0F, 0.0F}));
    }
    return normals;
}

std::vector<glm::vec4> made_tangents(const ModelPrimitive& primitive,
                                     std::span<const glm::vec3> normals) {
    if (primitive.uv[0].empty()) {
        return {};
    }
    std::vector<Directions> sums(primitive.positions.size());
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corner = {
            primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
        const Directions of_triangle = directions(primitive, corner);
        for (const std::uint32_t vertex : corner) {
            sums[vertex].along_u += of_triangle.along_u;
            sums[vertex].along_v += of_triangle.along_v;
        }
    }
    std::vector<glm::vec4> tangents;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::vec3& n = normals[i];
        const glm::vec3 u = sums[i].along_u;
        const glm::vec3 t = unit(u - n * glm::dot(n, u), any_across(n));
        const float side = glm::dot(glm::cross(n, t), sums[i].along_v) < 0.0F ? -1.0F : 1.0F;
        tangents.emplace_back(t, side);
    }
    return tangents;
}

}  // namespace raks::render
