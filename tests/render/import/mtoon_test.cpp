// MToon of VRM 1.0, and the materials of VRM 0.x brought onto it.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "tests/render/import/vrm_text.hpp"

namespace {

using namespace raks;
using namespace raks::render;
using raks::test::ReadFigure;

ReadFigure read_toon1(const std::string& toon) {
    return raks::test::read_vrm1_text(
        "", "", R"(,"materials":[{"extensions":{"VRMC_materials_mtoon":)" + toon + "}}]");
}

TEST(MToon1, every_field_is_read) {
    const ReadFigure read = read_toon1(R"({"specVersion":"1.0","transparentWithZWrite":true,
        "renderQueueOffsetNumber":-3,"shadeColorFactor":[0.1,0.2,0.3],
        "shadeMultiplyTexture":{"index":1},"shadingShiftFactor":0.25,
        "shadingShiftTexture":{"index":2,"scale":0.5},"shadingToonyFactor":0.75,
        "giEqualizationFactor":0.5,"matcapFactor":[0.5,0.5,0.5],"matcapTexture":{"index":0},
        "parametricRimColorFactor":[1,0,0],"parametricRimFresnelPowerFactor":3,
        "parametricRimLiftFactor":0.1,"rimMultiplyTexture":{"index":1},"rimLightingMixFactor":0.2,
        "outlineWidthMode":"screenCoordinates","outlineWidthFactor":0.01,
        "outlineWidthMultiplyTexture":{"index":2},"outlineColorFactor":[0,0,1],
        "outlineLightingMixFactor":0.3,"uvAnimationMaskTexture":{"index":2},
        "uvAnimationScrollXSpeedFactor":0.1,"uvAnimationScrollYSpeedFactor":0.2,
        "uvAnimationRotationSpeedFactor":0.3})");
    ASSERT_EQ(read.error, "");
    ASSERT_TRUE(read.model.materials[0].mtoon);
    const MToon& toon = *read.model.materials[0].mtoon;
    EXPECT_TRUE(toon.transparent_with_z_write);
    EXPECT_EQ(toon.render_queue_offset, -3);
    EXPECT_EQ(toon.shade_colour, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(toon.shade_texture.texture, 1);
    EXPECT_FLOAT_EQ(toon.shading_shift, 0.25F);
    EXPECT_FLOAT_EQ(toon.shading_shift_texture_scale, 0.5F);
    EXPECT_FLOAT_EQ(toon.shading_toony, 0.75F);
    EXPECT_FLOAT_EQ(toon.gi_equalization, 0.5F);
    EXPECT_EQ(toon.matcap_texture.texture, 0);
    EXPECT_FLOAT_EQ(toon.rim_fresnel_power, 3.0F);
    EXPECT_FLOAT_EQ(toon.rim_lift, 0.1F);
    EXPECT_FLOAT_EQ(toon.rim_lighting_mix, 0.2F);
    EXPECT_EQ(toon.outline_mode, OutlineWidth::screen);
    EXPECT_FLOAT_EQ(toon.outline_width, 0.01F);
    EXPECT_FLOAT_EQ(toon.outline_lighting_mix, 0.3F);
    EXPECT_EQ(toon.uv_mask_texture.texture, 2);
    EXPECT_FLOAT_EQ(toon.uv_scroll_speed.y, 0.2F);
    EXPECT_FLOAT_EQ(toon.uv_rotation_speed, 0.3F);
    EXPECT_FALSE(read.model.materials[1].mtoon);
}

TEST(MToon1, what_is_missing_has_the_default_of_the_specification) {
    const ReadFigure read = read_toon1(R"({"specVersion":"1.0"})");
    const MToon& toon = *read.model.materials[0].mtoon;
    EXPECT_EQ(toon.shade_colour, glm::vec3(0.0F));
    EXPECT_FLOAT_EQ(toon.shading_toony, 0.9F);
    EXPECT_FLOAT_EQ(toon.gi_equalization, 0.9F);
    EXPECT_FLOAT_EQ(toon.rim_fresnel_power, 5.0F);
    EXPECT_EQ(toon.outline_mode, OutlineWidth::none);
}

TEST(MToon1, a_texture_that_is_not_there_costs_that_texture) {
    const ReadFigure read = read_toon1(
        R"({"specVersion":"1.0","shadeMultiplyTexture":{"index":9},"shadingToonyFactor":7})");
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(read.model.materials[0].mtoon->shade_texture.texture, -1);
    EXPECT_FLOAT_EQ(read.model.materials[0].mtoon->shading_toony, 1.0F);
    EXPECT_TRUE(read.warns("drawn without"));
    EXPECT_TRUE(read.warns("shadingToonyFactor: 7 is not in 0 .. 1; taken as 1"));
}

TEST(MToon1, of_a_later_version_is_left_to_gltf) {
    const ReadFigure read = read_toon1(R"({"specVersion":"2.0"})");
    EXPECT_FALSE(read.model.materials[0].mtoon);
    EXPECT_TRUE(read.warns("is not MToon 1.0"));
}

// ---- VRM 0.x

ReadFigure read_materials(const std::string& materials) {
    return raks::test::read_vrm0_text(R"(,"materialProperties":[)" + materials + "]");
}

std::string toon0(const std::string& floats,
                  const std::string& vectors = "",
                  const std::string& textures = "",
                  int queue = -1) {
    return R"({"shader":"VRM/MToon","renderQueue":)" + std::to_string(queue) +
           R"(,"floatProperties":{)" + floats + R"(},"vectorProperties":{)" + vectors +
           R"(},"textureProperties":{)" + textures + "}}";
}

MToon toon_of(const ReadFigure& read, std::size_t material = 0) {
    return read.model.materials[material].mtoon.value_or(MToon());
}

// UniVRM's own tests of its migration (MToon10.Tests, MigrationTests).
TEST(MToon0, the_band_of_light_moves_as_univrm_moves_it) {
    struct Row {
        const char* floats;
        float toony;
        float shift;
    };
    for (const Row& row : {
             Row{R"("_ShadeToony":0.9,"_ShadeShift":0)", 0.95F, -0.05F},
             Row{R"("_ShadeToony":0,"_ShadeShift":0)", 0.5F, -0.5F},
             Row{R"("_ShadeToony":0,"_ShadeShift":-1)", 0.0F, 0.0F},
             Row{R"("_ShadeToony":0.7,"_ShadeShift":-0.4)", 0.79F, 0.19F},
         }) {
        const MToon toon = toon_of(read_materials(toon0(row.floats)));
        EXPECT_NEAR(toon.shading_toony, row.toony, 1e-5F) << row.floats;
        EXPECT_NEAR(toon.shading_shift, row.shift, 1e-5F) << row.floats;
    }
    EXPECT_FLOAT_EQ(
        toon_of(read_materials(toon0(R"("_IndirectLightIntensity":0.75)"))).gi_equalization, 0.25F);
}

TEST(MToon0, colours_become_linear_and_textures_turn_over) {
    const ReadFigure read =
        read_materials(toon0("",
                             R"("_Color":[0.5,1,0,0.5],"_ShadeColor":[0.5,0,0,1],
        "_EmissionColor":[0.5,0,0,1],"_MainTex":[0.1,0.2,0.5,0.25])",
                             R"("_MainTex":1,"_SphereAdd":2)"));
    ASSERT_EQ(read.error, "");
    const ModelMaterial& material = read.model.materials[0];
    EXPECT_NEAR(material.base_colour.x, 0.2140F, 1e-4F);
    EXPECT_FLOAT_EQ(material.base_colour.w, 0.5F);
    EXPECT_FLOAT_EQ(material.emissive.x, 0.5F);
    EXPECT_EQ(material.base_texture.texture, 1);
    EXPECT_FLOAT_EQ(material.base_texture.offset.x, 0.1F);
    EXPECT_FLOAT_EQ(material.base_texture.offset.y, 1.0F - 0.2F - 0.25F);
    EXPECT_FLOAT_EQ(material.base_texture.scale.y, 0.25F);
    const MToon toon = toon_of(read);
    EXPECT_NEAR(toon.shade_colour.x, 0.2140F, 1e-4F);
    EXPECT_EQ(toon.shade_texture.texture, 1);  // of the lit side, as there is none of its own
    EXPECT_EQ(toon.matcap_texture.texture, 2);
    EXPECT_EQ(toon.matcap_texture.scale, glm::vec2(1.0F));
    EXPECT_EQ(toon.matcap_factor, glm::vec3(1.0F));
    EXPECT_EQ(toon_of(read_materials(toon0(""))).matcap_factor, glm::vec3(0.0F));
}

TEST(MToon0, outlines_are_measured_anew) {
    const MToon world = toon_of(
        read_materials(toon0(R"("_OutlineWidthMode":1,"_OutlineWidth":0.5,"_OutlineColorMode":1,
        "_OutlineLightingMix":0.25)")));
    EXPECT_EQ(world.outline_mode, OutlineWidth::world);
    EXPECT_FLOAT_EQ(world.outline_width, 0.005F);  // centimetres
    EXPECT_FLOAT_EQ(world.outline_lighting_mix, 0.25F);
    const MToon screen =
        toon_of(read_materials(toon0(R"("_OutlineWidthMode":2,"_OutlineWidth":0.5)")));
    EXPECT_EQ(screen.outline_mode, OutlineWidth::screen);
    EXPECT_FLOAT_EQ(screen.outline_width, 0.0025F);  // per cent of half the height
    EXPECT_FLOAT_EQ(screen.outline_lighting_mix, 0.0F);
}

TEST(MToon0, scrolling_turns_over_and_rotation_is_in_turns) {
    const MToon toon = toon_of(read_materials(
        toon0(R"("_UvAnimScrollX":0.1,"_UvAnimScrollY":0.2,"_UvAnimRotation":0.5)")));
    EXPECT_FLOAT_EQ(toon.uv_scroll_speed.x, 0.1F);
    EXPECT_FLOAT_EQ(toon.uv_scroll_speed.y, -0.2F);
    EXPECT_FLOAT_EQ(toon.uv_rotation_speed, std::numbers::pi_v<float>);
}

TEST(MToon0, blend_modes_and_the_order_of_drawing_stay) {
    const ReadFigure plain = read_materials(toon0(R"("_BlendMode":2)", "", "", 3005) + "," +
                                            toon0(R"("_BlendMode":2)", "", "", 3001));
    EXPECT_EQ(plain.model.materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_EQ(toon_of(plain, 0).render_queue_offset, 0);  // drawn last
    EXPECT_EQ(toon_of(plain, 1).render_queue_offset, -1);
    const ReadFigure deep = read_materials(toon0(R"("_BlendMode":3)", "", "", 2505) + "," +
                                           toon0(R"("_BlendMode":3)", "", "", 2501));
    EXPECT_TRUE(toon_of(deep).transparent_with_z_write);
    EXPECT_EQ(toon_of(deep, 0).render_queue_offset, 1);
    EXPECT_EQ(toon_of(deep, 1).render_queue_offset, 0);  // drawn first
    const ReadFigure cut = read_materials(toon0(R"("_BlendMode":1,"_Cutoff":0.3,"_CullMode":0)"));
    EXPECT_EQ(cut.model.materials[0].alpha_mode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(cut.model.materials[0].alpha_cutoff, 0.3F);
    EXPECT_TRUE(cut.model.materials[0].is_double_sided);
}

TEST(Materials0, unlit_shaders_of_old_exporters_are_unlit) {
    const ReadFigure read = read_materials(
        R"({"shader":"VRM/UnlitCutout","floatProperties":{"_Cutoff":0.25},
        "textureProperties":{"_MainTex":2}},
        {"shader":"VRM/UnlitTransparentZWrite","vectorProperties":{"_Color":[1,0.5,1,0.5]},
        "textureProperties":{"_MainTex":1}})");
    const ModelMaterial& cut = read.model.materials[0];
    EXPECT_TRUE(cut.is_unlit);
    EXPECT_FALSE(cut.mtoon);
    EXPECT_EQ(cut.alpha_mode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(cut.alpha_cutoff, 0.25F);
    EXPECT_EQ(cut.base_texture.texture, 2);
    const ModelMaterial& deep = read.model.materials[1];
    EXPECT_EQ(deep.alpha_mode, AlphaMode::blend);
    EXPECT_EQ(deep.base_colour, glm::vec4(0.0F, 0.0F, 0.0F, 0.5F));
    EXPECT_NEAR(deep.emissive.y, 0.2140F, 1e-4F);
    EXPECT_EQ(deep.emissive_texture.texture, 1);
    EXPECT_TRUE(deep.mtoon->transparent_with_z_write);
}

TEST(Materials0, other_shaders_are_as_gltf_says) {
    const ReadFigure read =
        read_materials(R"({"shader":"VRM_USE_GLTFSHADER"},{"shader":"My/Shader"})");
    EXPECT_FALSE(read.model.materials[0].mtoon);
    EXPECT_FALSE(read.model.materials[1].mtoon);
    EXPECT_TRUE(read.warns("the shader \"My/Shader\" is not known"));
    EXPECT_FALSE(read.warns("VRM_USE_GLTFSHADER"));
}

TEST(Materials0, a_texture_that_is_not_there_is_left_out) {
    const ReadFigure read = read_materials(toon0("", "", R"("_MainTex":77)"));
    EXPECT_EQ(read.model.materials[0].base_texture.texture, -1);
    EXPECT_TRUE(read.warns("_MainTex: 77 does not exist: there are 3, counted from 0; left out"));
}

}  // namespace
