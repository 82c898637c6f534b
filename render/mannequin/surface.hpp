#pragma once

#include <array>
#include <cstdint>
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

/// Octree dual contouring of the skin; each vertex is projected to the field. Cells are 2.4 mm at
/// the lids, 4.8 mm at face and fingers, 9.5 mm at hands, feet and head, 19 mm elsewhere. Normals
/// are left empty. Threads: any. Real-time: no.
[[nodiscard]] MirroredMesh extract_surface(const BodyField& field, const BindFrames& frames);

}  // namespace raks::render
