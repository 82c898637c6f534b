// Bones by names: the schemes of 25 tools, as ../shared/data/avatars/names.tsv has them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/import/bind_places.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/humanoid_names.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/vrm_text.hpp"

namespace {

using namespace raks;
using namespace raks::render;
using motion::Bone;
using motion::Side;

/// How a tool names bones. `L` in a name stands for the side; trunk names from the hips up.
struct Scheme {
    const char* tool;
    std::string left;  ///< what `@` becomes
    std::string right;
    std::vector<std::string> trunk;  ///< hips, then what carries the arms last
    std::vector<std::string> neck;   ///< neck (or none) and head
    std::vector<std::string> arm;    ///< from the first joint to the hand
    std::vector<std::string> leg;    ///< from the first joint to foot or toes
    std::vector<std::string> thumb = {};
    std::vector<std::string> index = {};
};

std::string with_side(std::string name, const std::string& side) {
    if (const std::size_t at = name.find('@'); at != std::string::npos) {
        name.replace(at, 1, side);
    }
    return name;
}

int add_chain(Model& model,
              int parent,
              const std::vector<std::string>& names,
              const std::string& side,
              const glm::vec3& first,
              const glm::vec3& step) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        parent =
            raks::test::add_node(model, with_side(names[i], side), parent, i == 0 ? first : step);
    }
    return parent;
}

Model figure_of(const Scheme& scheme) {
    Model model;
    const int root = raks::test::add_node(model, "Root Node", -1);
    const int hips = raks::test::add_node(model, scheme.trunk.front(), root, {0, 1, 0});
    int top = hips;
    for (std::size_t i = 1; i < scheme.trunk.size(); ++i) {
        top = raks::test::add_node(model, scheme.trunk[i], top, {0, 0.15F, 0});
    }
    add_chain(model, top, scheme.neck, "", {0, 0.2F, 0}, {0, 0.1F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string& word = side > 0.0F ? scheme.left : scheme.right;
        add_chain(model, hips, scheme.leg, word, {0.1F * side, -0.05F, 0}, {0, -0.4F, 0.01F});
        const int hand =
            add_chain(model, top, scheme.arm, word, {0.1F * side, 0.1F, 0}, {0.2F * side, 0, 0});
        add_chain(model, hand, scheme.thumb, word, {0.05F * side, 0, 0.05F}, {0.03F * side, 0, 0});
        add_chain(model, hand, scheme.index, word, {0.1F * side, 0, 0.02F}, {0.03F * side, 0, 0});
    }
    return model;
}

const std::vector<Scheme>& schemes() {
    static const std::vector<Scheme> all = {
        {"VRM 1.0",
         "left",
         "right",
         {"hips", "spine", "chest", "upperChest"},
         {"neck", "head"},
         {"@Shoulder", "@UpperArm", "@LowerArm", "@Hand"},
         {"@UpperLeg", "@LowerLeg", "@Foot", "@Toes"},
         {"@ThumbMetacarpal", "@ThumbProximal", "@ThumbDistal"},
         {"@IndexProximal", "@IndexIntermediate", "@IndexDistal"}},
        {"Mixamo",
         "Left",
         "Right",
         {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2"},
         {"mixamorig:Neck", "mixamorig:Head"},
         {"mixamorig:@Shoulder", "mixamorig:@Arm", "mixamorig:@ForeArm", "mixamorig:@Hand"},
         {"mixamorig:@UpLeg", "mixamorig:@Leg", "mixamorig:@Foot", "mixamorig:@ToeBase"},
         {"mixamorig:@HandThumb1",
          "mixamorig:@HandThumb2",
          "mixamorig:@HandThumb3",
          "mixamorig:@HandThumb4"},
         {"mixamorig:@HandIndex1", "mixamorig:@HandIndex2", "mixamorig:@HandIndex3"}},
        {"Maya HumanIK",
         "Left",
         "Right",
         {"Character1_Hips", "Character1_Spine", "Character1_Spine1"},
         {"Character1_Neck", "Character1_Head"},
         {"Character1_@Shoulder", "Character1_@Arm", "Character1_@ForeArm", "Character1_@Hand"},
         {"Character1_@UpLeg", "Character1_@Leg", "Character1_@Foot", "Character1_@ToeBase"}},
        {"VRoid",
         "L",
         "R",
         {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest"},
         {"J_Bip_C_Neck", "J_Bip_C_Head"},
         {"J_Bip_@_Shoulder", "J_Bip_@_UpperArm", "J_Bip_@_LowerArm", "J_Bip_@_Hand"},
         {"J_Bip_@_UpperLeg", "J_Bip_@_LowerLeg", "J_Bip_@_Foot", "J_Bip_@_ToeBase"},
         {"J_Bip_@_Thumb1", "J_Bip_@_Thumb2", "J_Bip_@_Thumb3"},
         {"J_Bip_@_Index1", "J_Bip_@_Index2", "J_Bip_@_Index3"}},
        {"3ds Max Biped",
         "L",
         "R",
         {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1"},
         {"Bip01 Neck", "Bip01 Head", "Bip01 HeadNub"},
         {"Bip01 @ Clavicle", "Bip01 @ UpperArm", "Bip01 @ Forearm", "Bip01 @ Hand"},
         {"Bip01 @ Thigh", "Bip01 @ Calf", "Bip01 @ Foot", "Bip01 @ Toe0", "Bip01 @ Toe0Nub"},
         {"Bip01 @ Finger0", "Bip01 @ Finger01", "Bip01 @ Finger02"},
         {"Bip01 @ Finger1", "Bip01 @ Finger11", "Bip01 @ Finger12"}},
        {"Rigify meta rig",
         "L",
         "R",
         {"spine", "spine.001", "spine.002", "spine.003"},
         {"spine.004", "spine.005", "spine.006"},
         {"shoulder.@", "upper_arm.@", "forearm.@", "hand.@"},
         {"thigh.@", "shin.@", "foot.@", "toe.@"},
         {"thumb.01.@", "thumb.02.@", "thumb.03.@"},
         {"f_index.01.@", "f_index.02.@", "f_index.03.@"}},
        {"Rigify DEF",
         "L",
         "R",
         {"DEF-hips", "DEF-spine.001", "DEF-spine.002", "DEF-spine.003"},
         {"DEF-neck", "DEF-head"},
         {"DEF-shoulder.@", "DEF-upper_arm.@", "DEF-forearm.@", "DEF-hand.@"},
         {"DEF-thigh.@", "DEF-shin.@", "DEF-foot.@", "DEF-toe.@"}},
        {"Unreal",
         "l",
         "r",
         {"pelvis", "spine_01", "spine_02", "spine_03"},
         {"neck_01", "head"},
         {"clavicle_@", "upperarm_@", "lowerarm_@", "hand_@"},
         {"thigh_@", "calf_@", "foot_@", "ball_@"},
         {"thumb_01_@", "thumb_02_@", "thumb_03_@"}},
        {"Reallusion CC",
         "L",
         "R",
         {"CC_Base_Hip", "CC_Base_Waist", "CC_Base_Spine01", "CC_Base_Spine02"},
         {"CC_Base_NeckTwist01", "CC_Base_Head"},
         {"CC_Base_@_Clavicle", "CC_Base_@_Upperarm", "CC_Base_@_Forearm", "CC_Base_@_Hand"},
         {"CC_Base_@_Thigh", "CC_Base_@_Calf", "CC_Base_@_Foot", "CC_Base_@_ToeBase"}},
        {"MakeHuman",
         "L",
         "R",
         {"root", "spine04", "spine03", "spine02"},
         {"neck01", "head"},
         {"shoulder01.@", "upperarm01.@", "lowerarm01.@", "wrist.@"},
         {"upperleg01.@", "lowerleg01.@", "foot.@"},
         {"finger1-1.@", "finger1-2.@", "finger1-3.@"},
         {"finger2-1.@", "finger2-2.@", "finger2-3.@"}},
        {"MikuMikuDance",
         "左",
         "右",
         {"センター", "上半身", "上半身2"},
         {"首", "頭"},
         {"@肩", "@腕", "@ひじ", "@手首"},
         {"@足", "@ひざ", "@足首", "@つま先"},
         {"@親指０", "@親指１", "@親指２"},
         {"@人指１", "@人指２", "@人指３"}},
        {"Cats",
         "Left",
         "Right",
         {"Hips", "Spine", "Chest"},
         {"Neck", "Head"},
         {"@ shoulder", "@ arm", "@ elbow", "@ wrist"},
         {"@ leg", "@ knee", "@ ankle", "@ toe"}},
        {"VRM Add-on",
         "L",
         "R",
         {"hips", "spine", "chest", "upper_chest"},
         {"neck", "head"},
         {"shoulder.@", "upper_arm.@", "lower_arm.@", "hand.@"},
         {"upper_leg.@", "lower_leg.@", "foot.@", "toes.@"},
         {"thumb.proximal.@", "thumb.intermediate.@", "thumb.distal.@"},
         {"index.proximal.@", "index.intermediate.@", "index.distal.@"}},
        {"KayKit",
         "l",
         "r",
         {"hips", "spine", "chest"},
         {"head"},
         {"upperarm.@", "lowerarm.@", "wrist.@"},
         {"upperleg.@", "lowerleg.@", "foot.@", "toes.@"}},
        {"Quaternius",
         "L",
         "R",
         {"Hips", "Abdomen", "Torso"},
         {"Neck", "Head"},
         {"Shoulder.@", "UpperArm.@", "LowerArm.@", "Palm.@"},
         {"UpperLeg.@", "LowerLeg.@", "Foot.@"}},
        {"Khronos",
         "L",
         "R",
         {"torso_joint_1", "torso_joint_2", "torso_joint_3"},
         {"neck_joint_1", "neck_joint_2"},
         {"arm_joint_@_1", "arm_joint_@_2", "arm_joint_@_3"},
         {"leg_joint_@_1", "leg_joint_@_2", "leg_joint_@_3", "leg_joint_@_5"}},
        {"astro boy",
         "l",
         "r",
         {"pelvis", "spine"},
         {"null_head"},
         {"@_humerus", "@_ulna", "@_wrist"},
         {"@_hip", "@_knee", "@_ankle", "@_null_toe"}},
        {"CMU",
         "Left",
         "Right",
         {"Hips", "LowerBack", "Spine", "Spine1"},
         {"Neck", "Neck1", "Head"},
         {"@Shoulder", "@Arm", "@ForeArm", "@Hand"},
         {"@UpLeg", "@Leg", "@Foot", "@ToeBase"}},
        {"Daz",
         "l",
         "r",
         {"hip", "abdomenLower", "abdomenUpper", "chestLower", "chestUpper"},
         {"neckLower", "neckUpper", "head"},
         {"@Collar", "@ShldrBend", "@ForearmBend", "@Hand"},
         {"@ThighBend", "@Shin", "@Foot", "@Toe"},
         {"@Thumb1", "@Thumb2", "@Thumb3"},
         {"@Index1", "@Index2", "@Index3"}},
    };
    return all;
}

std::string name_at(const Model& model, const HumanoidMap& map, Bone bone) {
    const int node = map.nodes[motion::index_of(bone)];
    return node < 0 ? "-" : model.nodes[static_cast<std::size_t>(node)].name;
}

TEST(HumanoidNames, limbs_of_all_schemes_are_found) {
    for (const Scheme& scheme : schemes()) {
        SCOPED_TRACE(scheme.tool);
        const Model model = figure_of(scheme);
        const HumanoidMap map = map_by_names(model);
        EXPECT_EQ(missing_bones(map), "");
        EXPECT_EQ(name_at(model, map, Bone::hips), scheme.trunk.front());
        EXPECT_EQ(name_at(model, map, Bone::spine), scheme.trunk[1]);
        for (const Side side : motion::kSides) {
            const std::string& word = side == Side::left ? scheme.left : scheme.right;
            const std::size_t shoulder = scheme.arm.size() - 3;
            constexpr std::array kArm = {
                Bone::left_shoulder, Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand};
            for (std::size_t i = 0; i < scheme.arm.size(); ++i) {
                EXPECT_EQ(name_at(model, map, on_side(kArm[i + 1 - shoulder], side)),
                          with_side(scheme.arm[i], word));
            }
            constexpr std::array kLeg = {
                Bone::left_upper_leg, Bone::left_lower_leg, Bone::left_foot, Bone::left_toes};
            for (std::size_t i = 0; i < scheme.leg.size() && i < 4; ++i) {
                EXPECT_EQ(name_at(model, map, on_side(kLeg[i], side)),
                          with_side(scheme.leg[i], word));
            }
        }
    }
}

TEST(HumanoidNames, trunks_and_heads_of_all_schemes_are_found) {
    const auto last = [](const std::vector<std::string>& names) { return names.back(); };
    for (const Scheme& scheme : schemes()) {
        SCOPED_TRACE(scheme.tool);
        const Model model = figure_of(scheme);
        const HumanoidMap map = map_by_names(model);
        const bool is_biped = scheme.neck.back() == "Bip01 HeadNub";
        EXPECT_EQ(name_at(model, map, Bone::head), is_biped ? scheme.neck[1] : last(scheme.neck));
        EXPECT_EQ(name_at(model, map, Bone::neck),
                  scheme.neck.size() > 1 ? scheme.neck.front() : "-");
        const bool is_daz = scheme.trunk.size() == 5;
        EXPECT_EQ(name_at(model, map, Bone::chest),
                  scheme.trunk.size() < 3 ? "-" : scheme.trunk[is_daz ? 3 : 2]);
        EXPECT_EQ(name_at(model, map, Bone::upper_chest),
                  scheme.trunk.size() > 3 ? last(scheme.trunk) : "-");
    }
}

TEST(HumanoidNames, fingers_are_counted_from_the_palm) {
    for (const Scheme& scheme : schemes()) {
        SCOPED_TRACE(scheme.tool);
        const Model model = figure_of(scheme);
        const HumanoidMap map = map_by_names(model);
        constexpr std::array kThumb = {
            Bone::left_thumb_metacarpal, Bone::left_thumb_proximal, Bone::left_thumb_distal};
        constexpr std::array kIndex = {
            Bone::left_index_proximal, Bone::left_index_intermediate, Bone::left_index_distal};
        for (std::size_t i = 0; i < 3; ++i) {
            for (const Side side : motion::kSides) {
                const std::string& word = side == Side::left ? scheme.left : scheme.right;
                EXPECT_EQ(name_at(model, map, on_side(kThumb[i], side)),
                          scheme.thumb.empty() ? "-" : with_side(scheme.thumb[i], word));
                EXPECT_EQ(name_at(model, map, on_side(kIndex[i], side)),
                          scheme.index.empty() ? "-" : with_side(scheme.index[i], word));
            }
        }
    }
}

TEST(HumanoidNames, joints_come_before_meshes_of_the_same_name) {
    Model model = raks::test::small_figure();
    const int mesh = raks::test::add_node(model, "head", -1);
    model.skins.emplace_back();
    for (int node = 0; node < mesh; ++node) {
        model.skins[0].joints.push_back(node);
        model.skins[0].inverse_bind.emplace_back(1.0F);
    }
    const HumanoidMap map = map_by_names(model);
    EXPECT_EQ(map.nodes[motion::index_of(Bone::head)], 2);
}

TEST(HumanoidNames, hips_are_what_carries_legs_and_trunk) {
    // A robot whose "Hips" carry the trunk alone; its legs hang on "Body".
    Model model;
    const int body = raks::test::add_node(model, "Body", -1, {0, 1, 0});
    const int hips = raks::test::add_node(model, "Hips", body);
    const int abdomen = raks::test::add_node(model, "Abdomen", hips, {0, 0.2F, 0});
    const int head = raks::test::add_node(model, "Head", abdomen, {0, 0.3F, 0});
    for (const float side : {1.0F, -1.0F}) {
        const std::string end = side > 0.0F ? ".L" : ".R";
        const int arm =
            raks::test::add_node(model, "UpperArm" + end, abdomen, {0.2F * side, 0.2F, 0});
        raks::test::add_node(
            model,
            "Hand" + end,
            raks::test::add_node(model, "LowerArm" + end, arm, {0.3F * side, 0, 0}));
        const int leg = raks::test::add_node(model, "UpperLeg" + end, body, {0.1F * side, 0, 0});
        raks::test::add_node(
            model, "Foot" + end, raks::test::add_node(model, "LowerLeg" + end, leg, {0, -0.5F, 0}));
    }
    const HumanoidMap map = map_by_names(model);
    EXPECT_EQ(map.nodes[motion::index_of(Bone::hips)], body);
    EXPECT_EQ(map.nodes[motion::index_of(Bone::spine)], abdomen);
    EXPECT_EQ(map.nodes[motion::index_of(Bone::head)], head);
}

}  // namespace
