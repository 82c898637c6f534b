// What a model file says of its surfaces: images, textures, materials.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::render {

/// An image as it lies in the file, still packed. Its head has been looked at: the size is known
/// and within bounds before anything is unpacked (render/import/image_file.hpp).
struct ModelImage {
    std::string name;
    std::vector<std::byte> packed;  ///< PNG, JPEG or WebP; empty: it could not be read
    int width = 0;                  ///< pixels
    int height = 0;
    int halvings = 0;  ///< so many times its sides are halved when it is unpacked
};

enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };

/// An image and how it is sampled.
struct ModelTexture {
    int image = -1;  ///< in Model::images; -1: none, drawn white
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_smooth = true;    ///< linear between texels when magnified; else nearest
    bool has_mipmaps = true;  ///< smaller copies are used when it is far away
};

/// Where a material uses a texture. KHR_texture_transform: uv' = offset + R(rotation) (scale uv).
struct TextureUse {
    int texture = -1;  ///< in Model::textures; -1: none
    int uv_set = 0;    ///< 0 or 1
    glm::vec2 offset{0.0F};
    glm::vec2 scale{1.0F};
    float rotation = 0.0F;  ///< radians, counter-clockwise in uv space as glTF defines it
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

enum class OutlineWidth : std::uint8_t { none, world, screen };

/// VRMC_materials_mtoon 1.0; materials of VRM 0.x are brought onto it.
/// Colours are linear factors. Names and formulas are the specification's.
struct MToon {
    bool transparent_with_z_write = false;
    int render_queue_offset = 0;  ///< -9..9, of blended materials alone
    glm::vec3 shade_colour{0.0F};
    TextureUse shade_texture;
    float shading_shift = 0.0F;
    TextureUse shading_shift_texture;
    float shading_shift_texture_scale = 1.0F;
    float shading_toony = 0.9F;
    float gi_equalization = 0.9F;
    glm::vec3 matcap_factor{1.0F};
    TextureUse matcap_texture;
    glm::vec3 rim_colour{0.0F};
    TextureUse rim_texture;
    float rim_lighting_mix = 1.0F;
    float rim_fresnel_power = 5.0F;
    float rim_lift = 0.0F;
    /// An expression gives the rim a colour; set by build_avatar.
    bool has_face_rim = false;
    OutlineWidth outline_mode = OutlineWidth::none;
    float outline_width =
        0.0F;  ///< metres in the file's unit, or a fraction of the picture's height
    TextureUse outline_width_texture;
    glm::vec3 outline_colour{0.0F};
    float outline_lighting_mix = 1.0F;
    TextureUse uv_mask_texture;
    glm::vec2 uv_scroll_speed{0.0F};  ///< texture widths a second
    float uv_rotation_speed = 0.0F;   ///< radians a second
};

/// A surface. The fields up to `is_unlit` are glTF's metallic-roughness model.
struct ModelMaterial {
    std::string name;
    glm::vec4 base_colour{1.0F};  ///< linear
    TextureUse base_texture;
    float metallic = 1.0F;
    float roughness = 1.0F;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    float normal_scale = 1.0F;
    TextureUse occlusion_texture;
    float occlusion_strength = 1.0F;
    glm::vec3 emissive{0.0F};  ///< times its strength (KHR_materials_emissive_strength)
    TextureUse emissive_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool is_double_sided = false;
    bool is_unlit = false;  ///< KHR_materials_unlit
    /// Vertices name a colour of the dancer's dress and their openness in their second texture
    /// coordinates (render/mannequin/painted_mesh.hpp); of no file.
    bool is_painted = false;
    bool is_costume = false;     ///< drawn with Dress::dancer alone; of no file
    std::optional<MToon> mtoon;  ///< wins over all other ways of shading
};

}  // namespace raks::render
