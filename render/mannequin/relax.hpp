#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/surface.hpp"

namespace raks::render {

/// Mesh vertices that share an edge with each vertex of the left half.
class Neighbours {
 public:
    /// Reads the mesh once and keeps no reference; the mesh must be closed.
    explicit Neighbours(const MirroredMesh& mesh);

    /// Mesh vertices (of both halves) around a vertex of the left half, in no particular order.
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t left_vertex) const noexcept {
        return std::span(list_).subspan(first_[left_vertex],
                                        first_[left_vertex + 1] - first_[left_vertex]);
    }

 private:
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> list_;
};

/// Evens out the triangles by tangential Laplacian smoothing: each vertex slides along the surface
/// toward the mean of its neighbours and is put back on the surface. Then sets the normals from the
/// field's gradient.
void relax(const BodyField& field, const Neighbours& neighbours, MirroredMesh& mesh);

}  // namespace raks::render
