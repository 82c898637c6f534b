#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A mirror-symmetric surface of which only the left half is stored: mesh vertex 2 i is
/// `positions[i]`, vertex 2 i + 1 its mirror image at x = 0. No vertex lies on the mirror plane;
/// triangles may span it.
struct MirroredMesh {
    std::vector<glm::vec3> positions;                     ///< left half, bind pose, metres
    std::vector<glm::vec3> normals;                       ///< left half, unit
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< both halves, by mesh vertex

    [[nodiscard]] glm::vec3 position(std::uint32_t vertex) const noexcept {
        const glm::vec3& p = positions[vertex / 2];
        return vertex % 2 == 0 ? p : glm::vec3{-p.x, p.y, p.z};
    }
};

/// Octree dual contouring of the skin; each vertex is projected to the field. Cells are
/// 4.8 mm at face and fingers, 9.5 mm at hands, feet and head, 19 mm elsewhere. Normals
/// are left empty. Threads: any. Real-time: no.
[[nodiscard]] MirroredMesh extract_surface(const BodyField& field, const BindFrames& frames);

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
