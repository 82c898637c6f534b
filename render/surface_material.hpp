#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/avatar/expressions.hpp"
#include "render/avatar/surface.hpp"
#include "render/renderer.hpp"

#include <glm/vec4.hpp>

namespace raks::render {

/// What a texture of a surface is for; the order of uv_rows in gl/shaders/surface.glsl.
enum class SurfaceSlot : std::uint8_t {
    base,
    shade,
    shift,
    normal,
    emissive,
    occlusion,
    metallic_roughness,
    rim,
    outline,
    motion,
    matcap,  ///< read by the view's normal: it has no transform
};
inline constexpr std::size_t kSurfaceSlots = 11;

/// Names of a slot's sampler ("base_map") and of the macro that asks for it ("HAS_BASE").
struct SlotNames {
    std::string_view sampler;
    std::string_view macro;
    bool is_colour;  ///< holds shown colours (sRGB), else numbers
};
[[nodiscard]] const SlotNames& slot_names(SurfaceSlot slot) noexcept;

/// The use of a slot's texture in a material; texture -1 where it has none.
[[nodiscard]] const TextureUse& slot_use(const ModelMaterial& material, SurfaceSlot slot) noexcept;

/// The uniform block of surface.glsl, which says what each member is. std140: vec4 alone.
struct SurfaceUniforms {
    glm::vec4 base_colour{1.0F};
    glm::vec4 shade_colour{};
    glm::vec4 emissive{};
    glm::vec4 rim_colour{};
    glm::vec4 matcap_factor{};
    glm::vec4 outline_colour{};
    glm::vec4 shading{};
    glm::vec4 rim{};
    glm::vec4 other{};
    std::array<glm::vec4, 20> uv_rows{};  ///< two for each slot before `matcap`
};

/// A material's numbers as the shaders of `quality` (fast or high) take them. Pure.
[[nodiscard]] SurfaceUniforms surface_uniforms(const ModelMaterial& material,
                                               Quality quality) noexcept;

/// The material as expressions change it. Pure.
[[nodiscard]] ModelMaterial with_face(ModelMaterial material, const MaterialFace& face) noexcept;

/// How a surface is drawn: which pass wants a program of its own.
enum class SurfacePass : std::uint8_t { colour, outline, depth };

/// The macros that choose a material's shaders: only what it has costs anything. Pure.
[[nodiscard]] std::vector<std::string_view> surface_macros(const ModelMaterial& material,
                                                           SurfacePass pass,
                                                           Quality quality);

}  // namespace raks::render
