// Bones, expressions, gaze and licence of VRM 1.0, VRM 0.x and VRMA.
#include <gtest/gtest.h>

#include <string>

#include "tests/render/import/vrm_text.hpp"
#include "tests/support/mangled.hpp"

namespace {

using namespace raks;
using namespace raks::render;
using motion::Bone;
using raks::test::read_vrm0_text;
using raks::test::read_vrm1_text;
using raks::test::ReadFigure;

int node_of_bone(const ReadFigure& read, Bone bone) {
    return read.model.character.humanoid.nodes[motion::index_of(bone)];
}

const Expression* expression(const ReadFigure& read, const std::string& name) {
    for (const Expression& one : read.model.character.expressions) {
        if (one.name == name) {
            return &one;
        }
    }
    return nullptr;
}

/// small_figure as VRM 1.0 with a change to the text of its bones.
ReadFigure read_with_bones(const std::string& from, const std::string& to) {
    Model model = raks::test::small_figure();
    std::string bones = raks::test::bones1(model);
    bones.replace(bones.find(from), from.size(), to);
    return raks::test::read_document(
        R"({"extensions":{"VRMC_vrm":{"specVersion":"1.0","humanoid":{"humanBones":{)" + bones +
            "}}}}}",
        std::move(model));
}

TEST(Vrm1, bones_are_nodes_of_the_file) {
    const ReadFigure read = read_vrm1_text(R"(,"meta":{"name":"A"})");
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(read.model.character.vrm, VrmVersion::vrm1);
    EXPECT_FALSE(read.model.character.faces_minus_z);
    EXPECT_EQ(node_of_bone(read, Bone::hips), 0);
    EXPECT_EQ(node_of_bone(read, Bone::left_foot), 5);
    EXPECT_EQ(node_of_bone(read, Bone::neck), -1);
    EXPECT_EQ(read.model.character.humanoid.reasons[motion::index_of(Bone::left_foot)],
              BoneReason::stated);
    EXPECT_TRUE(read.model.warnings.empty());
}

TEST(Vrm1, wrong_bones_are_refused_in_one_line) {
    struct Row {
        const char* from;
        const char* to;
        const char* error;
    };
    for (const Row& row : {
             Row{R"("hips":{"node":0},)", "", "its skeleton has no hips"},
             Row{R"("head":{"node":2})",
                 R"("head":{"node":999})",
                 "VRMC_vrm.humanoid.humanBones.head.node: 999 does not exist: there are 18, "
                 "counted from 0"},
             Row{R"("rightHand":{"node":14})",
                 R"("rightHand":{"node":8})",
                 "VRMC_vrm.humanoid.humanBones: leftHand and rightHand are the same node"},
             Row{R"("head":{"node":2})",
                 R"("head":{})",
                 "VRMC_vrm.humanoid.humanBones.head.node: is missing"},
             Row{R"("leftUpperLeg":{"node":3},"leftLowerLeg":{"node":4})",
                 R"("leftUpperLeg":{"node":4},"leftLowerLeg":{"node":3})",
                 "VRMC_vrm.humanoid.humanBones: leftLowerLeg lies above leftUpperLeg, of which it "
                 "is a part"},
         }) {
        EXPECT_EQ(read_with_bones(row.from, row.to).error, row.error);
    }
}

TEST(Vrm1, bones_that_are_odd_are_said) {
    const ReadFigure unknown =
        read_with_bones(R"("hips":{"node":0})", R"("hips":{"node":0},"leftTail":{"node":16})");
    EXPECT_EQ(unknown.error, "");
    EXPECT_TRUE(unknown.warns("there is no bone \"leftTail\""));
    const ReadFigure elsewhere =
        read_with_bones(R"("leftHand":{"node":8})", R"("leftHand":{"node":15})");
    EXPECT_EQ(elsewhere.error, "");
    EXPECT_TRUE(elsewhere.warns("leftHand does not lie below leftLowerArm"));
}

TEST(Vrm1, eyes_and_jaw_are_kept_beside_the_bones) {
    const ReadFigure read = read_with_bones(
        R"("hips":{"node":0})", R"("hips":{"node":0},"leftEye":{"node":15},"jaw":{"node":16})");
    EXPECT_EQ(read.model.character.humanoid.left_eye, 15);
    EXPECT_EQ(read.model.character.humanoid.right_eye, -1);
    EXPECT_EQ(read.model.character.humanoid.jaw, 16);
}

TEST(Vrm, extensions_of_another_kind_are_refused) {
    struct Row {
        const char* text;
        const char* error;
    };
    for (
        const Row& row : {
            Row{R"({"extensions":{"VRMC_vrm":[]}})", "VRMC_vrm is not an object"},
            Row{R"({"extensions":{"VRM":3}})", "VRM is not an object"},
            Row{R"({"extensions":{"VRMC_vrm":{"specVersion":"2.0"}}})",
                "VRMC_vrm.specVersion is not 1.0; save the model as VRM 1.0"},
            Row{R"({"extensions":{"VRMC_vrm":{"specVersion":"1.0","humanoid":null}}})",
                "its skeleton has no hips, spine, head, leftUpperLeg, leftLowerLeg, leftFoot, "
                "leftUpperArm, leftLowerArm, leftHand, rightUpperLeg, rightLowerLeg, rightFoot, "
                "rightUpperArm, rightLowerArm, rightHand"},
            Row{R"({"extensions":{"VRMC_vrm":{"specVersion":"1.0","humanoid":{"humanBones":[]}}}})",
                "VRMC_vrm.humanoid.humanBones: is a list, not an object"},
            Row{R"({"extensions":{"VRM":{"humanoid":{"humanBones":{}}}}})",
                "VRM.humanoid.humanBones: is an object, not a list"},
            Row{R"({"extensions":{"VRMC_vrm_animation":{"specVersion":"1.0"}}})",
                "VRMC_vrm_animation has no hips"},
        }) {
        EXPECT_EQ(raks::test::read_document(row.text, raks::test::small_figure()).error, row.error);
    }
}

TEST(Vrm, of_both_versions_the_newer_is_read) {
    const ReadFigure read = read_vrm1_text("", R"(,"VRM":{})");
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(read.model.character.vrm, VrmVersion::vrm1);
    EXPECT_TRUE(read.warns("VRM 1.0 is read"));
}

TEST(Vrm, a_model_without_it_has_no_character) {
    const ReadFigure read = raks::test::read_document("{}", raks::test::small_figure());
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(read.model.character.vrm, VrmVersion::none);
    EXPECT_EQ(node_of_bone(read, Bone::hips), -1);
}

TEST(Vrm1, expressions_move_morphs_colours_and_textures) {
    const ReadFigure read = read_vrm1_text(R"(,"expressions":{"preset":{"happy":{
        "isBinary":true,"overrideBlink":"block","overrideMouth":"blend",
        "morphTargetBinds":[{"node":2,"index":1,"weight":0.5}],
        "materialColorBinds":[{"material":1,"type":"shadeColor","targetValue":[1,0.5,0,1]}],
        "textureTransformBinds":[{"material":0,"scale":[0.5,1],"offset":[0.25,0]}]}},
        "custom":{"grin":{}}})");
    ASSERT_EQ(read.error, "");
    const Expression* const happy = expression(read, "happy");
    ASSERT_NE(happy, nullptr);
    EXPECT_TRUE(happy->is_preset);
    EXPECT_TRUE(happy->is_binary);
    EXPECT_EQ(happy->override_blink, ExpressionOverride::block);
    EXPECT_EQ(happy->override_look_at, ExpressionOverride::none);
    EXPECT_EQ(happy->override_mouth, ExpressionOverride::blend);
    ASSERT_EQ(happy->morphs.size(), 1U);
    EXPECT_EQ(happy->morphs[0].target, 1);
    EXPECT_FLOAT_EQ(happy->morphs[0].weight, 0.5F);
    ASSERT_EQ(happy->colours.size(), 1U);
    EXPECT_EQ(happy->colours[0].kind, ColourBindKind::shade);
    EXPECT_FLOAT_EQ(happy->colours[0].target.y, 0.5F);
    ASSERT_EQ(happy->textures.size(), 1U);
    EXPECT_FLOAT_EQ(happy->textures[0].offset.x, 0.25F);
    ASSERT_NE(expression(read, "grin"), nullptr);
    EXPECT_FALSE(expression(read, "grin")->is_preset);
}

TEST(Vrm1, a_bad_bind_costs_that_bind) {
    const ReadFigure read = read_vrm1_text(R"(,"expressions":{"preset":{"aa":{"morphTargetBinds":[
        {"node":900,"index":0},{"node":2,"index":50},{"node":0,"index":0},{"node":2,"index":0,
        "weight":1e30},{"index":0}]}}})");
    ASSERT_EQ(read.error, "");
    ASSERT_EQ(expression(read, "aa")->morphs.size(), 1U);
    EXPECT_EQ(expression(read, "aa")->morphs[0].weight, 1.0F);
    EXPECT_TRUE(read.warns("morphTargetBinds[0].node: 900 does not exist: there are 18"));
    EXPECT_TRUE(read.warns("morphTargetBinds[1].index: 50 does not exist: there are 2"));
    EXPECT_TRUE(read.warns("is not in 0 .. 1; taken as 1"));
}

TEST(Vrm1, gaze_has_ranges_that_can_be_divided_by) {
    const ReadFigure read = read_vrm1_text(R"(,"lookAt":{"type":"expression",
        "rangeMapHorizontalInner":{"inputMaxValue":0,"outputScale":0.5}})");
    const LookAt& gaze = read.model.character.look_at;
    EXPECT_TRUE(read.model.character.has_look_at);
    EXPECT_FALSE(gaze.is_by_bones);
    EXPECT_GT(gaze.horizontal_inner.input_max, 0.0F);
    EXPECT_FLOAT_EQ(gaze.horizontal_inner.output_scale, 0.5F);
    EXPECT_FLOAT_EQ(gaze.horizontal_outer.output_scale, 1.0F);
    EXPECT_FLOAT_EQ(gaze.offset_from_head.y, 0.06F);
    EXPECT_TRUE(read.warns("inputMaxValue: 0 is not in"));
}

TEST(Vrm1, the_licence_says_who_and_whether_to_credit) {
    const ReadFigure read = read_vrm1_text(R"(,"meta":{"name":"Mia","version":"2",
        "authors":["Ann","Bo"],"licenseUrl":"https://vrm.dev/licenses/1.0/",
        "creditNotation":"unnecessary","allowRedistribution":true,"modification":"prohibited"})");
    const Licence& licence = read.model.character.licence;
    EXPECT_EQ(licence.title, "Mia");
    EXPECT_EQ(licence.authors, (std::vector<std::string>{"Ann", "Bo"}));
    EXPECT_FALSE(licence.is_credit_required);
    const std::vector<std::pair<std::string, std::string>> terms = {
        {"creditNotation", "unnecessary"},
        {"allowRedistribution", "true"},
        {"modification", "prohibited"}};
    EXPECT_EQ(licence.terms, terms);
    EXPECT_TRUE(
        read_vrm1_text(R"(,"meta":{"name":"Mia"})").model.character.licence.is_credit_required);
    EXPECT_TRUE(read_vrm1_text().warns("meta: is missing"));
}

TEST(Vrm1, texts_of_makers_fit_one_line) {
    const ReadFigure read = read_vrm1_text(R"(,"meta":{"name":"a\u001b[31m\nb","authors":[")" +
                                           std::string(5000, 'x') + R"("]})");
    EXPECT_EQ(read.model.character.licence.title, "a?[31m?b");
    EXPECT_LE(read.model.character.licence.authors.at(0).size(), 400U);
    EXPECT_TRUE(read.warns("mended"));
}

TEST(Vrm0, faces_the_other_way_and_renames_thumbs) {
    Model model = raks::test::small_figure();
    const int thumb = raks::test::add_node(model, "thumb", 8);
    const std::string bones = raks::test::bones0(model).substr(
                                  0, raks::test::bones0(model).rfind(",{\"bone\":\"thumb\"")) +
                              R"(,{"bone":"leftThumbProximal","node":)" + std::to_string(thumb) +
                              "}";
    const ReadFigure read = raks::test::read_document(
        R"({"extensions":{"VRM":{"humanoid":{"humanBones":[)" + bones + "]}}}}", model);
    ASSERT_EQ(read.error, "");
    EXPECT_TRUE(read.model.character.faces_minus_z);
    EXPECT_EQ(node_of_bone(read, Bone::left_thumb_metacarpal), thumb);
    EXPECT_EQ(node_of_bone(read, Bone::left_thumb_proximal), -1);
    EXPECT_TRUE(read.warns("no chest or no neck"));
}

TEST(Vrm0, blend_shapes_name_meshes_and_become_expressions) {
    const ReadFigure read = read_vrm0_text(R"(,"blendShapeMaster":{"blendShapeGroups":[
        {"name":"Joy!","presetName":"joy","isBinary":true,
         "binds":[{"mesh":0,"index":1,"weight":40},{"mesh":9,"index":0,"weight":1}],
         "materialValues":[
           {"materialName":"cloth","propertyName":"_Color","targetValue":[1,0.5,0,0.5]},
           {"materialName":"skin","propertyName":"_MainTex_ST","targetValue":[0.5,0.25,0.1,0.2]},
           {"materialName":"no","propertyName":"_Color","targetValue":[1,1,1,1]}]},
        {"name":"Grin","presetName":"unknown"},{"name":"SURPRISED","presetName":"unknown"},
        {"name":"Again","presetName":"joy"}]})");
    ASSERT_EQ(read.error, "");
    const Expression* const happy = expression(read, "happy");
    ASSERT_NE(happy, nullptr);
    EXPECT_TRUE(happy->is_binary);
    ASSERT_EQ(happy->morphs.size(), 1U);
    EXPECT_EQ(happy->morphs[0].node, 2);
    EXPECT_FLOAT_EQ(happy->morphs[0].weight, 0.4F);
    ASSERT_EQ(happy->colours.size(), 1U);
    EXPECT_EQ(happy->colours[0].material, 1);
    EXPECT_NEAR(happy->colours[0].target.y, 0.2140F, 1e-4F);  // sRGB 0.5
    EXPECT_FLOAT_EQ(happy->colours[0].target.w, 0.5F);
    ASSERT_EQ(happy->textures.size(), 1U);
    EXPECT_FLOAT_EQ(happy->textures[0].offset.y, 1.0F - 0.2F - 0.25F);
    EXPECT_NE(expression(read, "Grin"), nullptr);
    ASSERT_NE(expression(read, "surprised"), nullptr) << "its maker's own word for a face of 1.0";
    EXPECT_TRUE(expression(read, "surprised")->is_preset);
    EXPECT_EQ(read.model.character.expressions.size(), 3U);
    EXPECT_TRUE(read.warns("the expression happy is there already"));
    EXPECT_TRUE(read.warns("binds[1].mesh: 9 does not exist: there are 1"));
    EXPECT_TRUE(read.warns("is not a material of the file"));
}

TEST(Vrm0, gaze_begins_before_a_face_that_looks_back) {
    const ReadFigure read = read_vrm0_text(R"(,"firstPerson":{"firstPersonBone":800,
        "firstPersonBoneOffset":{"x":0,"y":0.1,"z":0.2},"lookAtTypeName":"BlendShape",
        "lookAtVerticalUp":{"curve":[0,0,0,0,1,1,1,1],"xRange":60,"yRange":0.7}})");
    const LookAt& gaze = read.model.character.look_at;
    EXPECT_FALSE(gaze.is_by_bones);
    EXPECT_FLOAT_EQ(gaze.offset_from_head.z, -0.2F);
    EXPECT_FLOAT_EQ(gaze.vertical_up.input_max, 60.0F);
    EXPECT_FLOAT_EQ(gaze.vertical_down.output_scale, 1.0F);
    EXPECT_TRUE(read.warns("curves by which its eyes turn"));
    EXPECT_TRUE(read.warns("firstPersonBone: 800"));
}

TEST(Vrm0, credit_is_due_unless_the_licence_says_otherwise) {
    struct Row {
        const char* meta;
        bool is_due;
    };
    for (const Row& row : {
             Row{R"({"licenseName":"CC0"})", false},
             Row{R"({"licenseName":"CC_BY","author":"Ann"})", true},
             Row{R"({"licenseName":"Other","otherLicenseUrl":"https://x/?credit=unnecessary"})",
                 false},
             Row{R"({"licenseName":"Other","otherLicenseUrl":"https://x/"})", true},
         }) {
        const ReadFigure read = read_vrm0_text(std::string(R"(,"meta":)") + row.meta);
        EXPECT_EQ(read.model.character.licence.is_credit_required, row.is_due) << row.meta;
    }
}

TEST(VrmAnimation, names_bones_and_the_nodes_of_a_face) {
    const Model model = raks::test::small_figure();
    const ReadFigure read = raks::test::read_document(
        R"({"extensions":{"VRMC_vrm_animation":{"specVersion":"1.0","humanoid":{"humanBones":{)" +
            raks::test::bones1(model) +
            R"(}},"expressions":{"preset":{"aa":{"node":15},"oh":{"node":99}}},
            "lookAt":{"node":16}}}})",
        model);
    ASSERT_EQ(read.error, "");
    EXPECT_EQ(node_of_bone(read, Bone::left_foot), 5);
    ASSERT_EQ(read.model.animated_face.expressions.size(), 1U);
    EXPECT_EQ(read.model.animated_face.expressions[0], (std::pair<std::string, int>{"aa", 15}));
    EXPECT_EQ(read.model.animated_face.look_at, 16);
    EXPECT_TRUE(read.warns("oh.node: 99"));
}

/// A text with a bit of everything.
std::string rich_text(bool is_vrm1) {
    const Model model = raks::test::small_figure();
    return is_vrm1
               ? R"({"extensions":{"VRMC_vrm":{"specVersion":"1.0","humanoid":{"humanBones":{)" +
                     raks::test::bones1(model) +
                     R"(}},"meta":{"name":"M","authors":["A"]},"expressions":{"preset":{"aa":
                     {"morphTargetBinds":[{"node":2,"index":1,"weight":1}]}}},"lookAt":{"type":
                     "bone"}},"VRMC_springBone":{"colliders":[{"node":2,"shape":{"sphere":{"radius":
                     1}}}],"colliderGroups":[{"colliders":[0]}],"springs":[{"joints":[{"node":15},
                     {"node":16}],"colliderGroups":[0],"center":0}]}},"nodes":[{"extensions":
                     {"VRMC_node_constraint":{"constraint":{"roll":{"source":3,"rollAxis":"X"}}}}}],
                     "materials":[{"extensions":{"VRMC_materials_mtoon":{"specVersion":"1.0",
                     "shadeColorFactor":[1,0,0]}}}]})"
               : R"({"extensions":{"VRM":{"humanoid":{"humanBones":[)" + raks::test::bones0(model) +
                     R"(]},"meta":{"title":"M"},"blendShapeMaster":{"blendShapeGroups":[{"name":"A",
                     "presetName":"a","binds":[{"mesh":0,"index":1,"weight":9}]}]},
                     "secondaryAnimation":{"boneGroups":[{"bones":[15],"colliderGroups":[0],
                     "stiffiness":1}],"colliderGroups":[{"node":2,"colliders":[{"radius":1}]}]},
                     "materialProperties":[{"shader":"VRM/MToon","floatProperties":{"_BlendMode":2},
                     "vectorProperties":{"_Color":[1,1,1,1]},"textureProperties":{"_MainTex":0}}]}}})";
}

TEST(VrmMangled, any_damaged_text_is_read_or_refused) {
    for (const bool is_vrm1 : {true, false}) {
        const std::string text = rich_text(is_vrm1);
        ASSERT_EQ(raks::test::read_document(text, raks::test::small_figure()).error, "");
        for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
            const ReadFigure read = raks::test::read_document(
                raks::test::mangled(text, {.seed = seed, .bytes = 1 + seed % 3}),
                raks::test::small_figure());
            EXPECT_EQ(read.error.find('\n'), std::string::npos);
        }
        for (std::size_t cut = 0; cut < text.size(); ++cut) {
            EXPECT_NE(
                raks::test::read_document(text.substr(0, cut), raks::test::small_figure()).error,
                "");
        }
    }
}

}  // namespace
