#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A place in the grid, in finest cells from the corner of the root cube; x from the mirror plane.
using GridPoint = std::array<int, 3>;

/// A leaf of the octree, `size` finest cells wide.
struct SurfaceCell {
    GridPoint corner{};
    int size = 1;
    /// Group of each corner: the inside corners that hang together by edges of the cell share one;
    /// -1 outside. Corner k is at (k & 1, k >> 1 & 1, k >> 2 & 1).
    std::array<int, 8> corner_groups{};
    int group_count = 0;
    /// Mesh vertex (left half) of group 0; those of the other groups follow it. -1: none yet.
    int first_vertex = -1;
};

/// The octree over the left half of the body: leaves near the surface and the field's values at
/// their corners.
class SurfaceCells {
 public:
    SurfaceCells(const BodyField& field, const BindFrames& frames);

    [[nodiscard]] std::vector<SurfaceCell>& leaves() noexcept { return leaves_; }
    /// The leaf that holds the finest cell at `place`; nullptr where the octree has no leaf of 8
    /// cells or fewer.
    [[nodiscard]] SurfaceCell* leaf_at(GridPoint place) noexcept;
    /// The field at a grid point, computed once.
    [[nodiscard]] float value_at(GridPoint point);
    [[nodiscard]] static glm::vec3 position(GridPoint point) noexcept;

 private:
    void split(GridPoint corner, int size);
    void add_leaf(GridPoint corner, int size);
    [[nodiscard]] int wanted_size(glm::vec3 p) const noexcept;

    const BodyField& field_;
    glm::vec3 wrist_{};
    glm::vec3 hand_axis_{};
    std::vector<SurfaceCell> leaves_;
    std::unordered_map<std::uint32_t, std::uint32_t> leaf_of_place_;
    std::unordered_map<std::uint32_t, float> values_;
};

/// Two ends of each edge of a cell, by corner number.
inline constexpr std::array<std::array<int, 2>, 12> kCellEdges = {{
    {0, 1},
    {2, 3},
    {4, 5},
    {6, 7},
    {0, 2},
    {1, 3},
    {4, 6},
    {5, 7},
    {0, 4},
    {1, 5},
    {2, 6},
    {3, 7},
}};

[[nodiscard]] constexpr GridPoint corner_of(const SurfaceCell& cell, int corner) noexcept {
    return {cell.corner[0] + (corner & 1) * cell.size,
            cell.corner[1] + (corner >> 1 & 1) * cell.size,
            cell.corner[2] + (corner >> 2 & 1) * cell.size};
}

}  // namespace raks::render
