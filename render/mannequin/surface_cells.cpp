#include "render/mannequin/surface_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr int kRootSize = 1024;       // finest cells along the root cube
constexpr float kRootMetres = 2.44F;  // 2.40, 2.44 and 2.52 give manifold meshes
constexpr float kCell = kRootMetres / static_cast<float>(kRootSize);
constexpr glm::vec3 kRootCorner{0.0F, -0.1F, -0.5F * kRootMetres};
constexpr int kLargestLeaf = 8;

// A cell is pruned when the field says that the surface is farther away than this. The field is no
// exact distance: with 1.5 half diagonals and 2 mm the mesh has holes where the leaf size changes.
constexpr float kPruneHalfDiagonals = 1.6F;
constexpr float kPruneMargin = 0.006F;
constexpr float kHalfDiagonal = 0.8660254F;  // of the unit cube

/// Hash key of a grid point: 10 bits a coordinate. The surface is nowhere near the far faces of the
/// root cube, where a coordinate would be 1024.
constexpr std::uint32_t key(GridPoint p) noexcept {
    return static_cast<std::uint32_t>(p[0]) | static_cast<std::uint32_t>(p[1]) << 10 |
           static_cast<std::uint32_t>(p[2]) << 20;
}

/// A leaf's key: its corner; the size, 1, 2, 4 or 8, in the two upper bits.
constexpr std::uint32_t leaf_key(GridPoint corner, int size) noexcept {
    const auto doublings =
        static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(size)));
    return key(corner) | doublings << 30;
}

}  // namespace

SurfaceCells::SurfaceCells(const BodyField& field, const BindFrames& frames)
    : field_(field),
      wrist_(frames.joint(motion::Bone::left_hand)),
      hand_axis_(frames.direction(motion::Bone::left_hand, {1.0F, 0.0F, 0.0F})) {
    // Rough sizes for the mannequin, so that the tables need not grow while they are filled.
    leaves_.reserve(24'000);
    leaf_of_place_.reserve(24'000);
    values_.reserve(48'000);
    // The left half of the root cube: four cubes, half as wide.
    constexpr int kHalf = kRootSize / 2;
    for (const GridPoint corner :
         {GridPoint{0, 0, 0}, {0, kHalf, 0}, {0, 0, kHalf}, {0, kHalf, kHalf}}) {
        split(corner, kHalf);
    }
}

glm::vec3 SurfaceCells::position(GridPoint p) noexcept {
    return kRootCorner + kCell * glm::vec3{static_cast<float>(p[0]),
                                           static_cast<float>(p[1]),
                                           static_cast<float>(p[2])};
}

float SurfaceCells::value_at(GridPoint point) {
    // A corner is shared by up to eight cells: the field is evaluated for the first of them only.
    const auto [entry, is_new] = values_.try_emplace(key(point), 0.0F);
    if (is_new) {
        entry->second = field_.distance(position(point));
    }
    return entry->second;
}

/// Largest leaf that keeps what is at `p`: fingers, thumb, face 2 (4.8 mm); palm, wrist, what
/// hair leaves free of the head, feet 4; the rest 8 (19 mm).
int SurfaceCells::wanted_size(glm::vec3 p) const noexcept {
    const glm::vec3 from_wrist = p - wrist_;
    const float along_hand = glm::dot(from_wrist, hand_axis_);
    const float away = glm::length(from_wrist);
    const bool is_face = p.z > 0.050F && p.y > 1.520F && p.y < 1.608F && p.x < 0.054F;
    const bool is_finger = along_hand > 0.050F && away < 0.24F;
    const bool is_thumb = along_hand > 0.005F && away < 0.24F && from_wrist.z > 0.034F;
    if (is_finger || is_thumb || is_face) {
        return 2;
    }
    const bool is_hand = along_hand > -0.020F && away < 0.28F;
    // Hair covers the skull above and behind the ears.
    const bool is_under_hair = p.y > 1.625F ? p.z < 0.045F : p.z < -0.045F;
    const bool is_head = p.y > 1.50F && p.x < 0.12F && !is_under_hair;
    const bool is_foot = p.y < 0.070F;
    return is_hand || is_head || is_foot ? 4 : kLargestLeaf;
}

/// Divides a cube until its leaves are as small as its place wants them, and prunes what is clear
/// of the surface.
void SurfaceCells::split(GridPoint corner, int size) {
    const glm::vec3 center = position(corner) + glm::vec3{0.5F * kCell * static_cast<float>(size)};
    const float half_diagonal = kHalfDiagonal * kCell * static_cast<float>(size);
    const float clear = kPruneHalfDiagonals * half_diagonal + kPruneMargin;
    if (size > 1 && std::abs(field_.distance(center)) > clear) {
        // A pruned small cube stays as an empty leaf: a smaller neighbour may need a vertex in it.
        if (size <= kLargestLeaf) {
            leaf_of_place_[leaf_key(corner, size)] = static_cast<std::uint32_t>(leaves_.size());
            leaves_.push_back({.corner = corner, .size = size, .corner_groups = {}});
            leaves_.back().corner_groups.fill(-1);
        }
        return;
    }
    if (size <= kLargestLeaf && size <= wanted_size(center)) {
        add_leaf(corner, size);
        return;
    }
    const int half = size / 2;
    for (int k = 0; k < 8; ++k) {
        split({corner[0] + (k & 1) * half,
               corner[1] + (k >> 1 & 1) * half,
               corner[2] + (k >> 2 & 1) * half},
              half);
    }
}

/// Adds a leaf that may hold surface and groups its inside corners: two limbs that pass through one
/// cell get two vertices, where one shared vertex would join them.
void SurfaceCells::add_leaf(GridPoint corner, int size) {
    SurfaceCell cell{.corner = corner, .size = size, .corner_groups = {}};
    std::array<int, 8> group{};
    for (int k = 0; k < 8; ++k) {
        group[static_cast<std::size_t>(k)] = value_at(corner_of(cell, k)) < 0.0F ? k : -1;
    }
    // Connected corners take the smallest number among them. A sweep carries a number along one
    // edge at least, and connected corners of a cube are at most four edges apart.
    for (int sweep = 0; sweep < 4; ++sweep) {
        for (const auto& edge : kCellEdges) {
            int& a = group[static_cast<std::size_t>(edge[0])];
            int& b = group[static_cast<std::size_t>(edge[1])];
            if (a >= 0 && b >= 0) {
                a = b = std::min(a, b);
            }
        }
    }
    // Numbers the groups from 0 in the order of their smallest corners.
    for (std::size_t k = 0; k < 8; ++k) {
        if (group[k] == static_cast<int>(k)) {
            cell.corner_groups[k] = cell.group_count++;
        } else {
            cell.corner_groups[k] = group[k] < 0
                                        ? std::int8_t{-1}
                                        : cell.corner_groups[static_cast<std::size_t>(group[k])];
        }
    }
    // A leaf wholly inside has no edge that crosses the surface, hence no vertex.
    const bool is_all_inside =
        std::all_of(group.begin(), group.end(), [](int g) { return g >= 0; });
    if (is_all_inside) {
        cell.group_count = 0;
    }
    leaf_of_place_[leaf_key(corner, size)] = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back(cell);
}

/// Clearing the low bits of a place gives the corner of the cube of each size that holds it.
SurfaceCell* SurfaceCells::leaf_at(GridPoint place) noexcept {
    for (int size = 1; size <= kLargestLeaf; size *= 2) {
        const GridPoint corner = {
            place[0] & ~(size - 1), place[1] & ~(size - 1), place[2] & ~(size - 1)};
        const auto found = leaf_of_place_.find(leaf_key(corner, size));
        if (found != leaf_of_place_.end()) {
            return &leaves_[found->second];
        }
    }
    return nullptr;
}

}  // namespace raks::render
