#include "render/surface_material.hpp"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr std::array<SlotNames, kSurfaceSlots> kSlotNames = {{
    {"base_map", "HAS_BASE", true},
    {"shade_map", "HAS_SHADE", true},
    {"shift_map", "HAS_SHIFT", false},
    {"normal_map", "HAS_NORMAL", false},
    {"emissive_map", "HAS_EMISSIVE", true},
    {"occlusion_map", "HAS_OCCLUSION", false},
    {"metallic_map", "HAS_METALLIC", false},
    {"rim_map", "HAS_RIM", true},
    {"outline_map", "HAS_OUTLINE", false},
    {"motion_map", "HAS_MOTION", false},
    {"matcap_map", "HAS_MATCAP", true},
}};

/// As display_colour of sRGB, squared: what a fast shader, whose square root shows it, must hold.
float as_square(float linear) noexcept {
    const float shown =
        linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
    return shown * shown;
}

glm::vec3 for_shader(glm::vec3 linear, Quality quality) noexcept {
    if (quality != Quality::fast) {
        return linear;
    }
    return {as_square(linear.r), as_square(linear.g), as_square(linear.b)};
}

void set_uv_rows(SurfaceUniforms& u, const ModelMaterial& material) noexcept {
    for (std::size_t i = 0; 2 * i < u.uv_rows.size(); ++i) {
        const TextureUse& use = slot_use(material, static_cast<SurfaceSlot>(i));
        const float c = std::cos(use.rotation);
        const float s = std::sin(use.rotation);
        // KHR_texture_transform: offset + rotation * scale.
        u.uv_rows[2 * i] = {
            c * use.scale.x, s * use.scale.y, use.offset.x, static_cast<float>(use.uv_set)};
        u.uv_rows[2 * i + 1] = {-s * use.scale.x, c * use.scale.y, use.offset.y, 0.0F};
    }
}

void set_toon(SurfaceUniforms& u, const MToon& toon, Quality quality) noexcept {
    u.shade_colour = {for_shader(toon.shade_colour, quality), toon.gi_equalization};
    u.rim_colour = {for_shader(toon.rim_colour, quality), toon.rim_lighting_mix};
    u.matcap_factor = {for_shader(toon.matcap_factor, quality), u.matcap_factor.a};
    u.outline_colour = {for_shader(toon.outline_colour, quality), toon.outline_lighting_mix};
    u.shading = {
        toon.shading_shift, toon.shading_toony, toon.shading_shift_texture_scale, u.shading.w};
    u.rim = {toon.rim_fresnel_power, toon.rim_lift, toon.outline_width, u.rim.w};
    u.other = {u.other.x, toon.uv_scroll_speed.x, toon.uv_scroll_speed.y, toon.uv_rotation_speed};
}

bool is_moving(const MToon& toon) noexcept {
    return toon.uv_scroll_speed != glm::vec2(0.0F) || toon.uv_rotation_speed != 0.0F;
}

bool has_slot(const ModelMaterial& material, SurfaceSlot slot, SurfacePass pass) noexcept {
    if (slot_use(material, slot).texture < 0) {
        return false;
    }
    if (pass == SurfacePass::depth) {
        return slot == SurfaceSlot::base && material.alpha_mode == AlphaMode::mask;
    }
    switch (slot) {
        case SurfaceSlot::base:
        case SurfaceSlot::emissive:
            return true;
        case SurfaceSlot::normal:
            return material.mtoon || !material.is_unlit;
        case SurfaceSlot::occlusion:
        case SurfaceSlot::metallic_roughness:
            return !material.mtoon && !material.is_unlit;
        case SurfaceSlot::outline:
            return pass == SurfacePass::outline;
        case SurfaceSlot::motion:
            return is_moving(*material.mtoon);
        default:
            return true;
    }
}

void add_toon_macros(const MToon& toon, SurfacePass pass, std::vector<std::string_view>& macros) {
    macros.emplace_back("TOON");
    if ((toon.rim_colour != glm::vec3(0.0F) || toon.has_face_rim) && pass == SurfacePass::colour) {
        macros.emplace_back("RIM");
    }
    if (pass == SurfacePass::outline) {
        macros.emplace_back("OUTLINE");
        if (toon.outline_mode == OutlineWidth::screen) {
            macros.emplace_back("OUTLINE_SCREEN");
        }
    }
}

}  // namespace

const SlotNames& slot_names(SurfaceSlot slot) noexcept {
    return kSlotNames[static_cast<std::size_t>(slot)];
}

const TextureUse& slot_use(const ModelMaterial& material, SurfaceSlot slot) noexcept {
    static constexpr TextureUse kNone{};
    const MToon* const toon = material.mtoon ? &*material.mtoon : nullptr;
    switch (slot) {
        case SurfaceSlot::base:
            return material.base_texture;
        case SurfaceSlot::normal:
            return material.normal_texture;
        case SurfaceSlot::emissive:
            return material.emissive_texture;
        case SurfaceSlot::occlusion:
            return material.occlusion_texture;
        case SurfaceSlot::metallic_roughness:
            return material.metallic_roughness_texture;
        case SurfaceSlot::shade:
            return toon != nullptr ? toon->shade_texture : kNone;
        case SurfaceSlot::shift:
            return toon != nullptr ? toon->shading_shift_texture : kNone;
        case SurfaceSlot::rim:
            return toon != nullptr ? toon->rim_texture : kNone;
        case SurfaceSlot::outline:
            return toon != nullptr ? toon->outline_width_texture : kNone;
        case SurfaceSlot::motion:
            return toon != nullptr ? toon->uv_mask_texture : kNone;
        case SurfaceSlot::matcap:
            return toon != nullptr ? toon->matcap_texture : kNone;
    }
    return kNone;
}

SurfaceUniforms surface_uniforms(const ModelMaterial& material, Quality quality) noexcept {
    SurfaceUniforms u;
    u.base_colour = {for_shader(glm::vec3(material.base_colour), quality), material.base_colour.a};
    u.emissive = {for_shader(material.emissive, quality), material.occlusion_strength};
    u.matcap_factor.a = material.normal_scale;
    u.shading.w = material.alpha_cutoff;
    u.rim.w = material.roughness;
    u.other.x = material.metallic;
    set_uv_rows(u, material);
    if (material.mtoon) {
        set_toon(u, *material.mtoon, quality);
    }
    return u;
}

ModelMaterial with_face(ModelMaterial material, const MaterialFace& face) noexcept {
    const auto colour = [&](ColourBindKind kind) {
        return face.colours[static_cast<std::size_t>(kind)];
    };
    material.base_colour = colour(ColourBindKind::base);
    material.emissive = glm::vec3(colour(ColourBindKind::emission));
    for (TextureUse* const use : {&material.base_texture,
                                  &material.normal_texture,
                                  &material.emissive_texture,
                                  &material.occlusion_texture,
                                  &material.metallic_roughness_texture}) {
        *use = face.moved(*use);
    }
    if (material.mtoon) {
        MToon& toon = *material.mtoon;
        toon.shade_colour = glm::vec3(colour(ColourBindKind::shade));
        toon.matcap_factor = glm::vec3(colour(ColourBindKind::matcap));
        toon.rim_colour = glm::vec3(colour(ColourBindKind::rim));
        toon.outline_colour = glm::vec3(colour(ColourBindKind::outline));
        for (TextureUse* const use : {&toon.shade_texture,
                                      &toon.shading_shift_texture,
                                      &toon.rim_texture,
                                      &toon.outline_width_texture,
                                      &toon.uv_mask_texture}) {
            *use = face.moved(*use);
        }
    }
    return material;
}

std::vector<std::string_view> surface_macros(const ModelMaterial& material,
                                             SurfacePass pass,
                                             Quality quality) {
    std::vector<std::string_view> macros = {"BONE_ROWS 1023"};
    if (quality == Quality::fast) {
        macros.emplace_back("FAST");
    }
    if (pass == SurfacePass::depth) {
        macros.emplace_back("DEPTH");
    } else if (material.mtoon) {
        add_toon_macros(*material.mtoon, pass, macros);
    } else if (!material.is_unlit) {
        macros.emplace_back("LIT");
        if (material.is_painted) {
            macros.emplace_back("PAINTED");
        }
    }
    if (material.alpha_mode == AlphaMode::mask) {
        macros.emplace_back("ALPHA_MASK");
    } else if (material.alpha_mode == AlphaMode::blend) {
        macros.emplace_back("ALPHA_BLEND");
    }
    for (std::size_t i = 0; i < kSurfaceSlots; ++i) {
        const auto slot = static_cast<SurfaceSlot>(i);
        if (has_slot(material, slot, pass)) {
            macros.push_back(slot_names(slot).macro);
        }
    }
    if (material.mtoon && is_moving(*material.mtoon) &&
        material.mtoon->uv_mask_texture.texture < 0) {
        macros.emplace_back("ANIMATED");
    }
    return macros;
}

}  // namespace raks::render
