#pragma once

#include <array>
#include <span>

#include "motion/skeleton/skeleton.hpp"
#include "render/gl/frame_target.hpp"
#include "render/scene/scene.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// What the shaders of one picture share: the uniform block of gl/shaders/frame.glsl, which says
/// what each member is. std140: everything is made of vec4.
struct FrameUniforms {
    glm::mat4 clip_from_world{};
    glm::mat4 shadow_from_world{};
    glm::vec4 eye{};
    glm::vec4 key_direction{};
    glm::vec4 fill_direction{};
    glm::vec4 rim_direction{};
    glm::vec4 key_light{};
    glm::vec4 fill_light{};
    glm::vec4 rim_light{};
    glm::vec4 sky_light{};
    glm::vec4 ground_light{};
    std::array<glm::vec4, 7> materials{};
    glm::vec4 display_top{};
    glm::vec4 display_glow{};
    glm::vec4 display_horizon{};
    glm::vec4 floor_centre{};
    glm::vec4 floor_edge{};
    glm::vec4 floor_key_tint{};
    glm::vec4 floor_sky_tint{};
    glm::vec4 display_ring{};
    std::array<glm::vec4, 4> rings{};
    std::array<glm::vec4, 44> blobs{};  // eleven a dancer
    glm::vec4 picture{};
    glm::vec4 tone{};
    glm::vec4 counts{};
};
static_assert(sizeof(FrameUniforms) == (8 + 9 + 7 + 8 + 4 + 44 + 3) * sizeof(glm::vec4));

/// The block for one picture and, beside it, the shadow map's projection.
struct FrameView {
    FrameUniforms uniforms;
    glm::mat4 clip_from_light{};
};
/// `dancers`: one to four.
[[nodiscard]] FrameView frame_view(const Scene& scene,
                                   std::span<const motion::WorldPose> dancers,
                                   const FrameTarget& target) noexcept;

/// A linear colour as shown (gamma 2.2).
[[nodiscard]] glm::vec3 display_colour(glm::vec3 linear) noexcept;

}  // namespace raks::render
