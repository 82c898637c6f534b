#include "render/mannequin/painted_mesh.hpp"

#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

std::uint32_t PaintedMesh::add(const PaintedPoint& point) {
    const std::uint32_t number = size();
    primitive_.positions.push_back(point.position);
    primitive_.normals.push_back(point.normal);
    primitive_.colours.emplace_back(point.tint, 1.0F);
    primitive_.uv[0].emplace_back(0.0F);
    // As surface.vert reads them of painted materials.
    primitive_.uv[1].emplace_back(static_cast<float>(point.paint), point.open);
    primitive_.joints.push_back(point.joints);
    primitive_.weights.push_back(point.weights);
    return number;
}

void PaintedMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool is_turned) {
    if (is_turned) {
        std::swap(b, c);
    }
    primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
}

void PaintedMesh::connect(const Grid& grid) {
    const std::uint32_t around = grid.is_ring ? grid.columns : grid.columns - 1;
    for (std::uint32_t row = 0; row + 1 < grid.rows; ++row) {
        for (std::uint32_t column = 0; column < around; ++column) {
            const std::uint32_t next = (column + 1) % grid.columns;
            const std::uint32_t above = grid.first + row * grid.columns;
            const std::uint32_t below = above + grid.columns;
            add_triangle(above + column, below + column, below + next, grid.is_turned);
            add_triangle(above + column, below + next, above + next, grid.is_turned);
        }
    }
}

ModelPrimitive PaintedMesh::take(int material) {
    primitive_.material = material;
    return std::move(primitive_);
}

}  // namespace raks::render
