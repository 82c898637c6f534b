#include <array>

#include "render/export/vrm_extensions.hpp"

namespace raks::render {
namespace {

void put_outline(const MToon& toon, GlbDocument& glb, Json& json) {
    constexpr std::array kModes = {"none", "worldCoordinates", "screenCoordinates"};
    json["outlineWidthMode"] = kModes[static_cast<std::size_t>(toon.outline_mode)];
    json["outlineWidthFactor"] = toon.outline_width;
    put_texture(toon.outline_width_texture, "outlineWidthMultiplyTexture", glb, json);
    json["outlineColorFactor"] = numbers_of(toon.outline_colour);
    json["outlineLightingMixFactor"] = toon.outline_lighting_mix;
}

Json mtoon_json(const MToon& toon, GlbDocument& glb) {
    Json json = {{"specVersion", "1.0"},
                 {"transparentWithZWrite", toon.transparent_with_z_write},
                 {"renderQueueOffsetNumber", toon.render_queue_offset},
                 {"shadeColorFactor", numbers_of(toon.shade_colour)}};
    put_texture(toon.shade_texture, "shadeMultiplyTexture", glb, json);
    json["shadingShiftFactor"] = toon.shading_shift;
    put_texture(toon.shading_shift_texture, "shadingShiftTexture", glb, json);
    if (toon.shading_shift_texture.texture >= 0) {
        json["shadingShiftTexture"]["scale"] = toon.shading_shift_texture_scale;
    }
    json["shadingToonyFactor"] = toon.shading_toony;
    json["giEqualizationFactor"] = toon.gi_equalization;
    json["matcapFactor"] = numbers_of(toon.matcap_factor);
    put_texture(toon.matcap_texture, "matcapTexture", glb, json);
    json["parametricRimColorFactor"] = numbers_of(toon.rim_colour);
    put_texture(toon.rim_texture, "rimMultiplyTexture", glb, json);
    json["rimLightingMixFactor"] = toon.rim_lighting_mix;
    json["parametricRimFresnelPowerFactor"] = toon.rim_fresnel_power;
    json["parametricRimLiftFactor"] = toon.rim_lift;
    put_outline(toon, glb, json);
    put_texture(toon.uv_mask_texture, "uvAnimationMaskTexture", glb, json);
    json["uvAnimationScrollXSpeedFactor"] = toon.uv_scroll_speed.x;
    json["uvAnimationScrollYSpeedFactor"] = toon.uv_scroll_speed.y;
    json["uvAnimationRotationSpeedFactor"] = toon.uv_rotation_speed;
    return json;
}

}  // namespace

void add_mtoon(const Model& model, GlbDocument& glb) {
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        if (model.materials[i].mtoon) {
            glb.use_extension("VRMC_materials_mtoon");
            glb.json()["materials"][i]["extensions"]["VRMC_materials_mtoon"] =
                mtoon_json(*model.materials[i].mtoon, glb);
        }
    }
}

}  // namespace raks::render
