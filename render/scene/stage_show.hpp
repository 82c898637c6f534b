#pragma once

#include <array>

#include "render/scene/scene.hpp"

#include <glm/vec3.hpp>

/// What tiles and beams of a theme do at a moment. Nobody is hurt by it: what a place of the floor
/// shows swells on one beat of four, and besides with the swells of LightShow. Pure. Threads: any.
namespace raks::render {

/// Brightness of the tiles of each kind, [0, 1].
[[nodiscard]] std::array<float, 4> tile_levels(const Scene& scene) noexcept;

/// One beam of light.
struct Beam {
    glm::vec3 lamp{};         ///< world space, metres
    glm::vec3 end{};          ///< on the floor
    float brightness = 0.0F;  ///< [0, 1], of the theme's strength
};

/// The beam of lamp `number` of the scene's theme, 0 at the left end of the row.
[[nodiscard]] Beam beam_at(const Scene& scene, int number) noexcept;

/// The factor on the stage's light by colour, from the theme's tints.
[[nodiscard]] glm::vec3 stage_tint(const Scene& scene) noexcept;

}  // namespace raks::render
