#pragma once

#include <array>
#include <span>

#include "motion/skeleton/skeleton.hpp"
#include "render/gl/frame_target.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/stage_light.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// What the shaders of one picture share: the uniform block of gl/shaders/frame.glsl, which says
/// what each member is. std140: everything is made of vec4.
struct FrameUniforms {
    /// The camera's projection of world space.
    glm::mat4 clip_from_world{};
    /// To [0, 1]^3 of the shadow map.
    glm::mat4 shadow_from_world{};
    /// Camera position, world space, metres.
    glm::vec4 eye{};
    /// Unit, toward the light, world space; also of the two below.
    glm::vec4 key_direction{};
    /// Toward the fill light.
    glm::vec4 fill_direction{};
    /// Toward the rim light.
    glm::vec4 rim_direction{};
    /// Linear colour, as of the lights below.
    glm::vec4 key_light{};
    /// Fill light.
    glm::vec4 fill_light{};
    /// Rim light.
    glm::vec4 rim_light{};
    /// Hemisphere light from above.
    glm::vec4 sky_light{};
    /// Hemisphere light from below.
    glm::vec4 ground_light{};
    /// Lights of drawn (toon) surfaces: key and ambient add to about 1.
    glm::vec4 toon_key{};
    /// From above.
    glm::vec4 toon_sky{};
    /// From below.
    glm::vec4 toon_ground{};
    /// Backdrop, with gamma applied, as all named display_.
    glm::vec4 display_top{};
    /// Glow in the middle of the backdrop.
    glm::vec4 display_glow{};
    /// Lower part of the backdrop.
    glm::vec4 display_horizon{};
    /// Linear albedo.
    glm::vec4 floor_centre{};
    /// Linear albedo.
    glm::vec4 floor_edge{};
    /// Key light on the floor, without the ambient share.
    glm::vec4 floor_key_tint{};
    /// The ambient share.
    glm::vec4 floor_sky_tint{};
    /// a: how far a ring covers the floor; 0: it only adds light.
    glm::vec4 display_ring{};
    /// Radius, brightness, half width of the line, strength of its glow.
    std::array<glm::vec4, 4> rings{};
    /// x, y, width, height in pixels.
    glm::vec4 picture{};
    /// Exposure; 1 on the stage, else 0; phase of the dither; pixels of 0.04 m at 1 m.
    glm::vec4 tone{};
    /// x: number of blobs; y: 1 shows light as it is, without the tone curve; z: size of the floor;
    /// w: 1 with shadows on it, else 0.
    glm::vec4 counts{};
    /// x: 1 / width^2 of the pool of light and the backdrop's glow; y: edge of a tile, metres; z:
    /// seconds; w: light of the haze.
    glm::vec4 show{};
    /// Light that tiles of each kind add, with gamma applied.
    std::array<glm::vec4, 4> tiles{};
    /// Of each beam the place of its lamp, world space, and its brightness.
    std::array<glm::vec4, kMostBeams> lamps{};
    /// Where it ends on the floor, and the number of its colour.
    std::array<glm::vec4, kMostBeams> beam_ends{};
    /// With gamma applied.
    std::array<glm::vec4, 3> beam_colours{};
};
static_assert(sizeof(FrameUniforms) ==
              (8 + 12 + 8 + 4 + 3 + 1 + 4 + 2 * kMostBeams + 3) * sizeof(glm::vec4));

/// Shadow blobs of all dancers, x, z, 1 / radius^2, strength each: the block "Blobs".
struct BlobUniforms {
    std::array<glm::vec4, 1012> blobs{};
};
/// Dancers whose blobs have a place; the others are drawn without.
inline constexpr std::size_t kMostShadowed = 1012 / kShadowBlobs;

/// The block for one picture and, beside it, the shadow map's projection.
struct FrameView {
    /// For the block "Frame".
    FrameUniforms uniforms;
    /// For the block "Blobs"; the first `uniforms.counts.x` are meant.
    BlobUniforms blobs;
    /// Orthographic, from the key light.
    glm::mat4 clip_from_light{};
};
/// Everything that the shaders share, for one picture of `scene` in `target`. `dancers`: at least
/// one; `scales`: of each, its size against the mannequin's. Pure.
[[nodiscard]] FrameView frame_view(const Scene& scene,
                                   std::span<const motion::WorldPose> dancers,
                                   std::span<const float> scales,
                                   const FrameTarget& target) noexcept;

/// A linear colour of the backdrop in the scene's light.
[[nodiscard]] glm::vec3 lit_backdrop(const Scene& scene, glm::vec3 linear) noexcept;

/// A linear colour as shown (gamma 2.2).
[[nodiscard]] glm::vec3 display_colour(glm::vec3 linear) noexcept;

}  // namespace raks::render
