#include "render/avatar/expressions.hpp"

#include <gtest/gtest.h>

#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

// A face of four morph targets on node 1, and one material.
Model face_model() {
    Model model;
    add_node(model, "body", -1, {});
    model.nodes[static_cast<std::size_t>(add_node(model, "face", 0, {}))].mesh = 0;
    ModelMesh mesh;
    mesh.primitives.resize(1);
    mesh.primitives[0].morphs.resize(4);
    mesh.morph_weights = {0.0F, 0.25F, 0.5F, 0.0F};
    model.meshes.push_back(mesh);
    ModelMaterial material;
    material.base_colour = {1.0F, 0.5F, 0.0F, 1.0F};
    model.materials.push_back(material);
    return model;
}

Expression expression(const std::string& name, int target, float weight = 1.0F) {
    Expression made;
    made.name = name;
    made.is_preset = true;
    made.morphs.push_back({.node = 1, .target = target, .weight = weight});
    return made;
}

struct Shown {
    ExpressionRig rig;
    FaceState state;

    explicit Shown(const Model& model)
        : rig(ExpressionRig::build(model)), state(rig.make_state()) {}
    const FaceState& with(const std::vector<float>& weights) {
        rig.apply(weights, state);
        return state;
    }
};

TEST(Expressions, binds_of_several_expressions_add_up) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 0, 0.5F), expression("aa", 0)};
    Shown face(model);
    EXPECT_FLOAT_EQ(face.with({1.0F, 0.25F}).morphs[0], 0.75F);
    EXPECT_FLOAT_EQ(face.with({0.5F, 0.0F}).morphs[0], 0.25F);
    EXPECT_FLOAT_EQ(face.with({0.0F, 0.0F}).morphs[0], 0.0F);
}

TEST(Expressions, targets_that_no_expression_sets_keep_their_weights_at_rest) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 1)};
    Shown face(model);
    EXPECT_EQ(face.state.morphs, (std::vector<float>{0.0F, 0.0F, 0.5F, 0.0F}));
    EXPECT_EQ(face.with({1.0F}).morphs, (std::vector<float>{0.0F, 1.0F, 0.5F, 0.0F}));
}

TEST(Expressions, weights_are_kept_within_0_and_1) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 0)};
    Shown face(model);
    EXPECT_EQ(face.with({3.0F}).morphs[0], 1.0F);
    EXPECT_EQ(face.with({-3.0F}).morphs[0], 0.0F);
}

TEST(Expressions, binary_ones_are_on_above_a_half) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 0)};
    model.character.expressions[0].is_binary = true;
    Shown face(model);
    EXPECT_EQ(face.with({0.5F}).morphs[0], 0.0F);
    EXPECT_EQ(face.with({0.51F}).morphs[0], 1.0F);
}

struct OverrideCase {
    ExpressionOverride how;
    float happy;
    bool is_blink_binary;
    float blink;
};

TEST(Expressions, overrides_hold_back_blinks) {
    constexpr auto kNone = ExpressionOverride::none;
    constexpr auto kBlock = ExpressionOverride::block;
    constexpr auto kBlend = ExpressionOverride::blend;
    for (const OverrideCase& c : {OverrideCase{kNone, 0.5F, false, 1.0F},
                                  OverrideCase{kBlock, 0.0F, false, 1.0F},
                                  OverrideCase{kBlock, 0.1F, false, 0.0F},
                                  OverrideCase{kBlend, 0.25F, false, 0.75F},
                                  OverrideCase{kBlend, 0.25F, true, 0.0F},
                                  OverrideCase{kBlend, 0.0F, true, 1.0F}}) {
        Model model = face_model();
        model.character.expressions = {expression("happy", 0), expression("blinkLeft", 1)};
        model.character.expressions[0].override_blink = c.how;
        model.character.expressions[1].is_binary = c.is_blink_binary;
        Shown face(model);
        EXPECT_FLOAT_EQ(face.with({c.happy, 1.0F}).morphs[1], c.blink)
            << static_cast<int>(c.how) << " " << c.happy << " " << c.is_blink_binary;
    }
}

TEST(Expressions, each_override_holds_back_its_own_group) {
    Model model = face_model();
    model.character.expressions = {
        expression("happy", 0), expression("lookUp", 1), expression("aa", 2), expression("ee", 3)};
    model.character.expressions[0].override_look_at = ExpressionOverride::block;
    model.character.expressions[0].override_mouth = ExpressionOverride::blend;
    Shown face(model);
    EXPECT_EQ(face.with({0.5F, 1.0F, 1.0F, 0.5F}).morphs,
              (std::vector<float>{0.5F, 0.0F, 0.5F, 0.25F}));
}

TEST(Expressions, overrides_of_several_expressions_add_up_to_all_at_most) {
    Model model = face_model();
    model.character.expressions = {
        expression("happy", 0), expression("relaxed", 1), expression("blink", 2)};
    model.character.expressions[0].override_blink = ExpressionOverride::blend;
    model.character.expressions[1].override_blink = ExpressionOverride::blend;
    Shown face(model);
    EXPECT_FLOAT_EQ(face.with({0.25F, 0.5F, 1.0F}).morphs[2], 0.25F);
    EXPECT_FLOAT_EQ(face.with({0.75F, 0.5F, 1.0F}).morphs[2], 0.0F);
}

TEST(Expressions, the_makers_own_of_a_presets_name_is_not_held_back) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 0), expression("blink", 1)};
    model.character.expressions[0].override_blink = ExpressionOverride::block;
    model.character.expressions[1].is_preset = false;
    Shown face(model);
    EXPECT_EQ(face.with({1.0F, 1.0F}).morphs[1], 1.0F);
}

TEST(Expressions, colours_move_towards_their_targets) {
    Model model = face_model();
    Expression blush;
    blush.name = "blush";
    blush.colours.push_back({.material = 0, .target = {0.0F, 0.0F, 1.0F, 0.5F}});
    blush.colours.push_back(
        {.material = 0, .kind = ColourBindKind::emission, .target = {0.4F, 0.0F, 0.0F, 1.0F}});
    model.character.expressions = {blush};
    Shown face(model);
    const FaceState& shown = face.with({0.5F});
    ASSERT_EQ(shown.materials.size(), 1U);
    EXPECT_EQ(shown.materials[0].colours[0], glm::vec4(0.5F, 0.25F, 0.5F, 0.75F));
    EXPECT_EQ(shown.materials[0].colours[1], glm::vec4(0.2F, 0.0F, 0.0F, 1.0F));
    EXPECT_EQ(face.with({0.0F}).materials[0].colours[0], model.materials[0].base_colour);
}

TEST(Expressions, texture_transforms_move_from_the_files_own) {
    Model model = face_model();
    Expression eyes;
    eyes.name = "eyes";
    eyes.textures.push_back({.material = 0, .scale = {0.5F, 1.0F}, .offset = {0.5F, 0.0F}});
    model.character.expressions = {eyes};
    Shown face(model);
    const TextureUse own{.texture = 0, .offset = {0.25F, 0.5F}, .scale = {2.0F, 1.0F}};
    const TextureUse half = face.with({0.5F}).materials[0].moved(own);
    EXPECT_EQ(half.offset, glm::vec2(0.375F, 0.25F));
    EXPECT_EQ(half.scale, glm::vec2(1.25F, 1.0F));
    const TextureUse none = face.with({0.0F}).materials[0].moved(own);
    EXPECT_EQ(none.offset, own.offset);
    EXPECT_EQ(none.scale, own.scale);
}

TEST(Expressions, a_face_sets_the_presets_that_the_model_has) {
    Model model = face_model();
    model.character.expressions = {expression("blink", 0), expression("wink of mine", 1)};
    const ExpressionRig rig = ExpressionRig::build(model);
    Face face;
    face.weight(FaceExpression::blink) = 0.5F;
    face.weight(FaceExpression::happy) = 1.0F;
    std::vector<float> weights(2, 9.0F);
    rig.spread(face, weights);
    EXPECT_EQ(weights, (std::vector<float>{0.5F, 0.0F}));
}

TEST(Expressions, applying_is_real_time_safe) {
    Model model = face_model();
    model.character.expressions = {expression("happy", 0), expression("blink", 1)};
    Shown face(model);
    const std::vector<float> weights = {0.5F, 1.0F};
    raks::test::RealtimeScope scope;
    face.rig.apply(weights, face.state);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
