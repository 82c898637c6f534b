// The mannequin's skin as plain triangles, each of one colour. For render/mannequin alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/avatar/avatar.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A vertex of the skin with all that changes along an edge.
struct SkinPoint {
    glm::vec3 position{0.0F};  ///< bind pose
    glm::vec3 normal{0.0F};
    std::array<float, kMaskCount> masks{};     ///< by AvatarMask, 1 = kMaskRange
    std::array<float, kPaletteSize> shares{};  ///< of the joints that move it; their sum is 1
};

struct CutSkin {
    std::vector<SkinPoint> points;
    std::vector<std::uint32_t> indices;  ///< triangles, counter-clockwise
    std::vector<Paint> paints;           ///< by triangle
};

/// The skin of the mannequin, cut along the edges that its shader draws in the dancer's dress
/// (gl/shaders/materials.glsl), so that no triangle has two colours. Closed as the skin is: cuts of
/// neighbours meet in the same points. Threads: any. Real-time: no.
[[nodiscard]] CutSkin cut_skin(const Avatar& mannequin);

}  // namespace raks::render
