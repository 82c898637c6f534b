// VRMC_materials_mtoon 1.0.
#include <fmt/format.h>

#include <array>

#include "render/import/lenient.hpp"
#include "render/import/vrm_parts.hpp"

namespace raks::render {
namespace {

constexpr NumberLimits kColour{0.0F, 1000.0F, 0.0F};  // linear; above 1 it glows
constexpr NumberLimits kSpeed{-1000.0F, 1000.0F, 0.0F};

glm::vec3 read_colour(const JsonField& field, const glm::vec3& otherwise, Model& model) {
    return lenient_vector(field, kColour, otherwise, model);
}

void read_shading(const JsonField& from, MToon& toon, Model& model) {
    toon.shade_colour = read_colour(from["shadeColorFactor"], toon.shade_colour, model);
    toon.shade_texture = lenient_texture(from["shadeMultiplyTexture"], model);
    toon.shading_shift = lenient_number(from["shadingShiftFactor"], {-2.0F, 2.0F, 0.0F}, model);
    const JsonField shift = from["shadingShiftTexture"];
    toon.shading_shift_texture = lenient_texture(shift, model);
    toon.shading_shift_texture_scale =
        lenient_number(shift["scale"], {-1000.0F, 1000.0F, 1.0F}, model);
    toon.shading_toony = lenient_number(from["shadingToonyFactor"], {0.0F, 1.0F, 0.9F}, model);
    toon.gi_equalization = lenient_number(from["giEqualizationFactor"], {0.0F, 1.0F, 0.9F}, model);
}

void read_rim(const JsonField& from, MToon& toon, Model& model) {
    toon.matcap_factor = read_colour(from["matcapFactor"], toon.matcap_factor, model);
    toon.matcap_texture = lenient_texture(from["matcapTexture"], model);
    toon.rim_colour = read_colour(from["parametricRimColorFactor"], toon.rim_colour, model);
    toon.rim_texture = lenient_texture(from["rimMultiplyTexture"], model);
    toon.rim_lighting_mix = lenient_number(from["rimLightingMixFactor"], {0.0F, 1.0F, 1.0F}, model);
    toon.rim_fresnel_power =
        lenient_number(from["parametricRimFresnelPowerFactor"], {0.0F, 1000.0F, 5.0F}, model);
    toon.rim_lift =
        lenient_number(from["parametricRimLiftFactor"], {-1000.0F, 1000.0F, 0.0F}, model);
}

void read_outline(const JsonField& from, MToon& toon, Model& model) {
    toon.outline_mode = static_cast<OutlineWidth>(lenient_choice(
        from["outlineWidthMode"], {"none", "worldCoordinates", "screenCoordinates"}, model));
    toon.outline_width = lenient_number(from["outlineWidthFactor"], {0.0F, 1000.0F, 0.0F}, model);
    toon.outline_width_texture = lenient_texture(from["outlineWidthMultiplyTexture"], model);
    toon.outline_colour = read_colour(from["outlineColorFactor"], toon.outline_colour, model);
    toon.outline_lighting_mix =
        lenient_number(from["outlineLightingMixFactor"], {0.0F, 1.0F, 1.0F}, model);
}

void read_uv_animation(const JsonField& from, MToon& toon, Model& model) {
    toon.uv_mask_texture = lenient_texture(from["uvAnimationMaskTexture"], model);
    toon.uv_scroll_speed = {lenient_number(from["uvAnimationScrollXSpeedFactor"], kSpeed, model),
                            lenient_number(from["uvAnimationScrollYSpeedFactor"], kSpeed, model)};
    toon.uv_rotation_speed = lenient_number(from["uvAnimationRotationSpeedFactor"], kSpeed, model);
}

MToon read_toon(const JsonField& from, Model& model) {
    MToon toon;
    toon.transparent_with_z_write = lenient_truth(from["transparentWithZWrite"], false, model);
    toon.render_queue_offset = static_cast<int>(
        lenient_number(from["renderQueueOffsetNumber"], {-9.0F, 9.0F, 0.0F}, model));
    read_shading(from, toon, model);
    read_rim(from, toon, model);
    read_outline(from, toon, model);
    read_uv_animation(from, toon, model);
    return toon;
}

}  // namespace

void read_mtoon1(const JsonField& materials, Model& model) {
    const std::vector<JsonField> all = materials.items();
    for (std::size_t i = 0; i < all.size() && i < model.materials.size(); ++i) {
        const JsonField toon = all[i]["extensions"]["VRMC_materials_mtoon"];
        if (!toon.exists()) {
            continue;
        }
        if (!toon.is_object() || !is_known_version(toon, model)) {
            warn(model, toon.line("is not MToon 1.0; drawn by its glTF material"));
            continue;
        }
        MToon read = read_toon(toon, model);
        model.materials[i].mtoon = read;
    }
}

}  // namespace raks::render
