#include "render/import/face_morphs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "render/model/expression_names.hpp"

namespace raks::render::face_morphs_test {
namespace {

/// A figure whose mesh, shown by its second node, has morph targets of these names.
Model with_targets(std::vector<std::string> names) {
    Model model;
    model.nodes.resize(2);
    model.nodes[1].mesh = 0;
    ModelMesh& mesh = model.meshes.emplace_back();
    mesh.morph_weights.assign(names.size(), 0.0F);
    mesh.primitives.emplace_back().morphs.resize(names.size());
    mesh.morph_names = std::move(names);
    return model;
}

std::vector<std::string> names_of(const Model& model) {
    std::vector<std::string> names;
    for (const Expression& one : model.character.expressions) {
        names.push_back(one.name);
    }
    return names;
}

const Expression* find(const Model& model, const std::string& name) {
    const auto& all = model.character.expressions;
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const Expression& one) { return one.name == name; });
    return found != all.end() ? &*found : nullptr;
}

TEST(FaceMorphs, of_arkit_smile_under_any_spelling) {
    for (const char* const left :
         {"mouthSmileLeft", "mouthSmile_L", "MouthSmileL", "blendShape1.mouthSmile_Left"}) {
        Model model = with_targets({"tongueOut", left});
        add_face_morphs(model);
        const Expression* const happy = find(model, "happy");
        ASSERT_NE(happy, nullptr) << left;
        EXPECT_TRUE(happy->is_preset);
        ASSERT_EQ(happy->morphs.size(), 1U);
        EXPECT_EQ(happy->morphs[0].node, 1);
        EXPECT_EQ(happy->morphs[0].target, 1);
    }
}

TEST(FaceMorphs, of_arkit_show_every_expression_and_look_by_targets) {
    Model model = with_targets(
        {"browDownLeft",     "browDownRight",     "browInnerUp",      "browOuterUpLeft",
         "browOuterUpRight", "eyeBlinkLeft",      "eyeBlinkRight",    "eyeLookDownLeft",
         "eyeLookDownRight", "eyeLookInLeft",     "eyeLookInRight",   "eyeLookOutLeft",
         "eyeLookOutRight",  "eyeLookUpLeft",     "eyeLookUpRight",   "eyeWideLeft",
         "eyeWideRight",     "jawOpen",           "mouthFrownLeft",   "mouthFrownRight",
         "mouthFunnel",      "mouthPucker",       "mouthSmileLeft",   "mouthSmileRight",
         "mouthStretchLeft", "mouthStretchRight", "mouthUpperUpLeft", "mouthUpperUpRight"});
    add_face_morphs(model);
    for (const std::string_view name : kFaceExpressionNames) {
        EXPECT_EQ(find(model, std::string(name)) != nullptr, name != "neutral") << name;
    }
    EXPECT_FALSE(find(model, "browUpLeft")->is_preset);
    EXPECT_TRUE(model.character.has_look_at);
    EXPECT_FALSE(model.character.look_at.is_by_bones);
}

TEST(FaceMorphs, of_oculus_are_vowels) {
    Model model =
        with_targets({"viseme_sil", "viseme_aa", "viseme_E", "viseme_I", "viseme_O", "viseme_U"});
    add_face_morphs(model);
    EXPECT_EQ(names_of(model), (std::vector<std::string>{"aa", "ih", "ou", "ee", "oh"}));
    Model other = with_targets({"vrc.v_aa", "vrc.v_oh"});
    add_face_morphs(other);
    EXPECT_EQ(names_of(other), (std::vector<std::string>{"aa", "oh"}));
}

TEST(FaceMorphs, of_vroid_are_known_by_how_their_names_end) {
    Model model = with_targets({"Face.M_F00_000_00_Fcl_ALL_Neutral",
                                "Face.M_F00_000_00_Fcl_ALL_Angry",
                                "Face.M_F00_000_00_Fcl_ALL_Joy",
                                "Face.M_F00_000_00_Fcl_EYE_Close",
                                "Face.M_F00_000_00_Fcl_EYE_Close_L",
                                "Face.M_F00_000_00_Fcl_MTH_A"});
    add_face_morphs(model);
    EXPECT_EQ(names_of(model),
              (std::vector<std::string>{"happy", "angry", "aa", "blink", "blinkLeft"}));
    EXPECT_EQ(find(model, "blink")->morphs[0].target, 3);
    EXPECT_EQ(find(model, "blinkLeft")->morphs[0].target, 4);
}

TEST(FaceMorphs, a_figure_that_has_expressions_keeps_its_own) {
    Model model = with_targets({"mouthSmileLeft"});
    model.character.expressions.emplace_back().name = "wink";
    add_face_morphs(model);
    EXPECT_EQ(names_of(model), std::vector<std::string>{"wink"});
}

TEST(FaceMorphs, of_other_names_give_nothing) {
    Model model = with_targets({"", "L", "biceps_L", "Fcl", "smiley", "v", "."});
    add_face_morphs(model);
    EXPECT_TRUE(model.character.expressions.empty());
}

}  // namespace
}  // namespace raks::render::face_morphs_test
