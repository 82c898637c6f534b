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
    explicit Neighbours(const MirroredMesh& mesh);

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t left_vertex) const noexcept {
        return std::span(list_).subspan(first_[left_vertex],
                                        first_[left_vertex + 1] - first_[left_vertex]);
    }

 private:
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> list_;
};

/// Evens out the triangles: each vertex slides along the surface toward the mean of its neighbours.
/// Then sets the normals from the field.
void relax(const BodyField& field, const Neighbours& neighbours, MirroredMesh& mesh);

}  // namespace raks::render
