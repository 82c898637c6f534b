// Which nodes are bones: by shape, by labels, checked by geometry; and how a figure stands.
#include <gtest/gtest.h>

#include <string>

#include "render/import/bind_places.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/humanoid_shape.hpp"
#include "render/import/standing_body.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/vrm_text.hpp"
#include "tests/support/mangled.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace {

using namespace raks;
using namespace raks::render;
using motion::Bone;

/// small_figure with toes, a neck and other names.
Model figure_named(const std::string& prefix) {
    Model model = raks::test::small_figure();
    for (const int foot : {5, 11}) {
        raks::test::add_node(model, "toes", foot, {0.0F, -0.05F, 0.15F});
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        model.nodes[i].name = prefix + std::to_string(i);
    }
    return model;
}

int node_of_bone(const Model& model, Bone bone) {
    return model.character.humanoid.nodes[motion::index_of(bone)];
}

bool warns(const Model& model, std::string_view words) {
    return raks::test::ReadFigure{.model = model, .error = {}}.warns(words);
}

glm::vec3 place(const StandingBody& standing, const Model& model, Bone bone) {
    return glm::vec3(standing.world[static_cast<std::size_t>(node_of_bone(model, bone))][3]);
}

TEST(HumanoidMap, a_figure_without_names_is_found_by_its_shape) {
    Model model = figure_named("Bone.");
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(node_of_bone(model, Bone::hips), 0);
    EXPECT_EQ(node_of_bone(model, Bone::spine), 1);
    EXPECT_EQ(node_of_bone(model, Bone::left_upper_leg), 3);
    EXPECT_EQ(node_of_bone(model, Bone::left_lower_leg), 4);
    EXPECT_EQ(node_of_bone(model, Bone::left_foot), 5);
    EXPECT_EQ(node_of_bone(model, Bone::left_upper_arm), 6);
    EXPECT_EQ(node_of_bone(model, Bone::left_hand), 8);
    EXPECT_EQ(node_of_bone(model, Bone::right_hand), 14);
    EXPECT_EQ(node_of_bone(model, Bone::right_toes), 19);
    EXPECT_EQ(model.character.humanoid.reasons[0], BoneReason::shape);
}

TEST(HumanoidMap, a_figure_that_faces_away_has_its_left_on_the_other_side) {
    Model model = figure_named("Bone.");
    for (const int toes : {18, 19}) {
        model.nodes[static_cast<std::size_t>(toes)].translation.z = -0.15F;
    }
    ASSERT_TRUE(map_humanoid(model));
    EXPECT_EQ(node_of_bone(model, Bone::left_hand), 14);
    EXPECT_EQ(node_of_bone(model, Bone::right_hand), 8);
}

TEST(HumanoidMap, a_left_that_lies_right_is_swapped_and_said) {
    Model model = raks::test::small_figure();
    for (ModelNode& node : model.nodes) {
        if (node.name.rfind("left", 0) == 0) {
            node.name.replace(0, 4, "right");
        } else if (node.name.rfind("right", 0) == 0) {
            node.name.replace(0, 5, "left");
        }
    }
    raks::test::add_node(model, "rightToes", 5, {0.0F, -0.05F, 0.15F});
    raks::test::add_node(model, "leftToes", 11, {0.0F, -0.05F, 0.15F});
    ASSERT_TRUE(map_humanoid(model));
    EXPECT_EQ(node_of_bone(model, Bone::left_hand), 8);
    EXPECT_EQ(model.character.humanoid.reasons[motion::index_of(Bone::left_hand)],
              BoneReason::swapped);
    EXPECT_TRUE(warns(model, "its left and right were named the wrong way round"));
}

TEST(HumanoidMap, what_is_missing_is_listed_in_one_line) {
    Model model;
    const int hips = raks::test::add_node(model, "hips", -1);
    raks::test::add_node(model, "head", raks::test::add_node(model, "spine", hips));
    const auto mapped = map_humanoid(model);
    ASSERT_FALSE(mapped);
    EXPECT_EQ(
        mapped.error().message,
        "no humanoid is found in it: no leftUpperLeg, leftLowerLeg, leftFoot, leftUpperArm, "
        "leftLowerArm, rightUpperLeg, rightLowerLeg, rightFoot, rightUpperArm, rightLowerArm; "
        "name its bones in a label file");
    Model empty;
    EXPECT_FALSE(map_humanoid(empty));
}

TEST(HumanoidMap, a_figure_on_four_legs_is_refused) {
    Model model = raks::test::small_figure();
    model.nodes[0].rotation = glm::angleAxis(1.5F, glm::vec3(1.0F, 0.0F, 0.0F));
    const auto mapped = map_humanoid(model);
    ASSERT_FALSE(mapped);
    EXPECT_EQ(mapped.error().message, "it does not stand upright on two legs");
}

TEST(HumanoidMap, what_the_file_says_stands) {
    Model model = raks::test::read_vrm1_text().model;
    model.nodes[5].name = "no foot";
    ASSERT_TRUE(map_humanoid(model));
    EXPECT_EQ(node_of_bone(model, Bone::left_foot), 5);
}

// ---- Label files

constexpr const char* kLabels = R"(format = "raks-avatar-labels"
version = 1
[bones]
hips = "Bone.0"
leftHand = "Bone.8"
)";

TEST(BoneLabels, win_over_names_and_shape) {
    const auto labels = read_bone_labels(kLabels, "me.toml");
    ASSERT_TRUE(labels) << labels.error().message;
    EXPECT_EQ(labels->bones.size(), 2U);
    Model model = figure_named("Bone.");
    ASSERT_TRUE(map_humanoid(model, &*labels));
    EXPECT_EQ(node_of_bone(model, Bone::left_hand), 8);
    EXPECT_EQ(model.character.humanoid.reasons[motion::index_of(Bone::left_hand)],
              BoneReason::label);
    EXPECT_EQ(model.character.humanoid.reasons[motion::index_of(Bone::right_hand)],
              BoneReason::shape);
}

TEST(BoneLabels, bad_files_are_refused_in_one_line) {
    const std::string head = "format = \"raks-avatar-labels\"\nversion = 1\n";
    struct Row {
        std::string text;
        const char* error;
    };
    for (const Row& row : {
             Row{"a=[}", nullptr},
             Row{"version = 1\n[bones]\nhips = \"a\"",
                 "me.toml: format must be \"raks-avatar-labels\""},
             Row{"format = \"raks-avatar-labels\"\nversion = 2\n[bones]\nhips = \"a\"",
                 "me.toml: version must be a number up to 1; is Raks older than the file?"},
             Row{head, "me.toml: needs a table [bones] with lines like hips = \"Pelvis\""},
             Row{head + "[bones]\nhips = 3\n", "me.toml: line 4: hips must be a text in quotes"},
         }) {
        const auto labels = read_bone_labels(row.text, "me.toml");
        ASSERT_FALSE(labels) << row.text;
        if (row.error != nullptr) {
            EXPECT_EQ(labels.error().message, row.error);
        }
    }
    EXPECT_NE(read_bone_labels(head + "[bones]\nlefthand = \"a\"\n", "me.toml")
                  .error()
                  .message.find("leftHand"),
              std::string::npos);
}

TEST(BoneLabels, nodes_that_are_not_there_or_serve_twice_are_said_and_the_rest_is_kept) {
    const std::string head = "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n";
    const auto mapped = [&head](const std::string& lines, bool has_two) {
        Model model = figure_named("Bone.");
        model.nodes[3].name = has_two ? "Bone.0" : "Bone.3";
        const auto labels = read_bone_labels(head + lines + "leftHand = \"Bone.8\"\n", "me.toml");
        EXPECT_TRUE(map_humanoid(model, &*labels));
        EXPECT_EQ(model.character.humanoid.reasons[motion::index_of(Bone::left_hand)],
                  BoneReason::label);
        EXPECT_EQ(node_of_bone(model, Bone::hips), 0);
        return model;
    };
    EXPECT_TRUE(warns(mapped("hips = \"Pelvis\"\n", false),
                      "me.toml: hips: the model has no node \"Pelvis\"; left out"));
    EXPECT_TRUE(warns(mapped("hips = \"Bone.0\"\nspine = \"Bone.0\"\n", false),
                      "me.toml: hips and spine are the same node; the second is left out"));
    EXPECT_TRUE(warns(mapped("hips = \"Bone.0\"\n", true),
                      "me.toml: hips: two nodes are named \"Bone.0\"; left out"));
}

TEST(BoneLabels, of_a_bone_with_several_lines_the_first_counts_and_the_others_are_said) {
    const std::string head = "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n";
    const auto labels = read_bone_labels(head +
                                             "hips = \"Bone.0\"\n"
                                             "leftHand = \"Bone.8\"\n"
                                             "  \"hips\" = {node = \"Bone.3\", axis = \"x\"}\n"
                                             "hips= \"Bone.2\" # again\n"
                                             "rightHand = \"Bone.14\"",
                                         "me.toml");
    ASSERT_TRUE(labels) << labels.error().message;
    const std::vector<BoneLabel> kept = {{.bone = Bone::hips, .node = "Bone.0"},
                                         {.bone = Bone::left_hand, .node = "Bone.8"},
                                         {.bone = Bone::right_hand, .node = "Bone.14"}};
    EXPECT_TRUE(
        std::is_permutation(labels->bones.begin(), labels->bones.end(), kept.begin(), kept.end()));
    const std::vector<std::string> said = {
        "me.toml: line 6: hips is on line 4 already; this line is left out",
        "me.toml: line 7: hips is on line 4 already; this line is left out"};
    EXPECT_EQ(labels->left_out, said);
    Model model = figure_named("Bone.");
    ASSERT_TRUE(map_humanoid(model, &*labels));
    EXPECT_TRUE(warns(model, said[0]) && warns(model, said[1]));

    const auto bad = read_bone_labels(head + "hips = \"a\"\nhips = \"b\"\nneck = [\n", "me.toml");
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().message.find("hips"), std::string::npos) << bad.error().message;
}

TEST(BoneLabels, of_a_bone_under_its_own_child_are_left_out_and_said) {
    Model model = figure_named("Bone.");
    const auto labels = read_bone_labels(
        "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n"
        "leftUpperLeg = \"Bone.5\"\nleftLowerLeg = \"Bone.4\"\n",
        "me.toml");
    static_cast<void>(map_humanoid(model, &*labels));
    EXPECT_TRUE(warns(model, "it carries the leftUpperLeg; left out"));
}

/// A man of six parts without a skin: trunk with arms, hips with legs; arms hang.
Model part_man() {
    Model model;
    const auto add =
        [&model](const char* name, int parent, const glm::vec3& place, const glm::vec3& end) {
            const int node = raks::test::add_node(model, name, parent, place);
            ModelPrimitive flesh;
            flesh.positions = {glm::vec3(0.0F), end, 0.5F * end + glm::vec3(0.0F, 0.0F, 0.01F)};
            flesh.indices = {0, 1, 2};
            model.nodes[static_cast<std::size_t>(node)].mesh =
                static_cast<int>(model.meshes.size());
            model.meshes.emplace_back().primitives = {flesh};
            return node;
        };
    const int hips = add("root", -1, {0, 0.9F, 0}, {0, 0.1F, 0});
    const int torso = add("torso", hips, {0, 0.1F, 0}, {0, 0.7F, 0});
    add("leg-left", hips, {0.1F, 0, 0}, {0, -0.9F, 0});
    add("leg-right", hips, {-0.1F, 0, 0}, {0, -0.9F, 0});
    add("arm-left", torso, {0.2F, 0.4F, 0}, {0, -0.6F, 0});
    add("arm-right", torso, {-0.2F, 0.4F, 0}, {0, -0.6F, 0});
    return model;
}

/// Where the left arm's own -y, along which its flesh lies, points in the T-pose.
glm::vec3 left_arm_in_t_pose(Model& model) {
    const StandingBody standing = stand_up(model);
    const auto arm = motion::index_of(Bone::left_upper_arm);
    const glm::mat3 world(
        standing.world[static_cast<std::size_t>(model.character.humanoid.nodes[arm])]);
    return standing.straighten[arm] * (world * glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST(HumanoidMap, of_rigid_parts_needs_one_for_a_limb) {
    Model model = part_man();
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_TRUE(model.character.humanoid.is_of_parts);
    EXPECT_EQ(missing_bones(model.character.humanoid), "");
    EXPECT_EQ(node_of_bone(model, Bone::hips), 0);
    EXPECT_EQ(node_of_bone(model, Bone::left_upper_arm), 4);
    EXPECT_EQ(node_of_bone(model, Bone::left_lower_arm), -1);
    // Arms that hang are lifted by what flesh they have.
    EXPECT_LT(glm::distance(left_arm_in_t_pose(model), glm::vec3(1, 0, 0)), 0.05F);
}

TEST(HumanoidMap, of_rigid_parts_whose_flesh_lies_about_the_joint_are_left_as_they_point) {
    // A sleeve round the joint, higher than it; the middle of the flesh is far off the arm's line.
    Model model = part_man();
    ModelPrimitive& arm = model.meshes[4].primitives[0];
    arm.positions = {{-0.3F, 0.3F, 0.0F}, {0.6F, 0.1F, 0.0F}, {-0.2F, 0.3F, 0.01F}};
    ASSERT_TRUE(map_humanoid(model));
    EXPECT_LT(glm::distance(left_arm_in_t_pose(model), glm::vec3(0, -1, 0)), 1e-3F);
}

TEST(HumanoidMap, of_rigid_parts_lifts_an_arm_along_its_flesh_though_its_joint_lies_beside_it) {
    Model model = part_man();
    for (glm::vec3& place : model.meshes[4].primitives.front().positions) {
        place.x -= 0.2F;
    }
    ASSERT_TRUE(map_humanoid(model));
    EXPECT_LT(glm::distance(left_arm_in_t_pose(model), glm::vec3(1, 0, 0)), 0.05F);
}

TEST(HumanoidMap, of_rigid_parts_lists_what_it_needs) {
    Model model = part_man();
    model.nodes[4].name = "thing";
    const auto mapped = map_humanoid(model);
    ASSERT_FALSE(mapped);
    EXPECT_EQ(mapped.error().message,
              "no humanoid is found in it: no leftUpperArm; name its bones in a label file");
}

TEST(BoneLabels, say_where_a_part_points_at_rest) {
    const std::string head = "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n";
    const auto labels =
        read_bone_labels(head + "leftUpperArm = {node = \"arm-left\", axis = \"z\"}\n", "me.toml");
    ASSERT_TRUE(labels) << labels.error().message;
    EXPECT_EQ(labels->bones[0].node, "arm-left");
    EXPECT_EQ(labels->bones[0].axis, glm::vec3(0, 0, 1));
    Model model = part_man();
    ASSERT_TRUE(map_humanoid(model, &*labels));
    const StandingBody standing = stand_up(model);
    const glm::vec3 lifted =
        standing.straighten[motion::index_of(Bone::left_upper_arm)] * glm::vec3(0.0F, 0.0F, 1.0F);
    EXPECT_LT(glm::distance(lifted, glm::vec3(1, 0, 0)), 1e-5F);
    for (const std::string value :
         {"{axis = \"z\"}", "{node = \"a\", axis = \"up\"}", "{node = \"a\", turn = 3}", "[]"}) {
        const auto bad = read_bone_labels(head + "leftUpperArm = " + value + "\n", "me.toml");
        ASSERT_FALSE(bad) << value;
        EXPECT_EQ(bad.error().message.rfind("me.toml: line 4: ", 0), 0U) << bad.error().message;
    }
}

TEST(BoneLabels, any_damaged_text_is_read_or_refused) {
    const std::string text = kLabels;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        const auto labels =
            read_bone_labels(raks::test::mangled(text, {.seed = seed, .bytes = 1 + seed % 3}), "m");
        if (!labels) {
            EXPECT_EQ(labels.error().message.find('\n'), std::string::npos);
        }
    }
    for (std::size_t cut = 0; cut < text.size(); ++cut) {
        const auto labels = read_bone_labels(text.substr(0, cut), "m");
        EXPECT_TRUE(!labels || cut > text.find("hips"));
    }
}

// ---- How a figure stands

TEST(StandingBody, a_pose_of_an_animation_is_no_bind_pose) {
    Model model = raks::test::small_figure();
    const std::vector<glm::mat4> bound = rest_world(model);
    model.skins.emplace_back();
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        model.skins[0].joints.push_back(static_cast<int>(node));
        model.skins[0].inverse_bind.push_back(glm::inverse(bound[node]));
    }
    model.nodes[6].rotation = glm::angleAxis(1.0F, glm::vec3(0.0F, 0.0F, 1.0F));
    model.nodes[0].translation.y = 1.4F;  // a jump
    const std::vector<glm::mat4> world = bind_world(model);
    for (std::size_t node = 0; node < bound.size(); ++node) {
        EXPECT_LT(glm::length(glm::vec3(world[node][3] - bound[node][3])), 1e-4F) << node;
    }
}

TEST(StandingBody, helpers_of_a_skin_bound_in_another_pose_hang_as_stored) {
    // The small skin is first in the file, was bound with arms hanging, and alone has the
    // helper.
    Model model = raks::test::small_figure();
    constexpr int kLowerArm = 7;
    raks::test::add_node(model, "helper", kLowerArm, {0.0F, 0.01F, 0.0F});
    const auto helper = static_cast<int>(model.nodes.size()) - 1;
    const std::vector<glm::mat4> rest = rest_world(model);
    Model hanging = model;
    hanging.nodes[6].rotation = glm::angleAxis(-0.8F, glm::vec3(0.0F, 0.0F, 1.0F));
    const std::vector<glm::mat4> other = rest_world(hanging);
    model.skins.resize(2);
    const auto bind = [&model](std::size_t skin, int node, const glm::mat4& world) {
        model.skins[skin].joints.push_back(node);
        model.skins[skin].inverse_bind.push_back(glm::inverse(world));
    };
    for (const int node : {6, kLowerArm, helper}) {
        bind(0, node, other[static_cast<std::size_t>(node)]);
    }
    for (int node = 0; node < helper; ++node) {
        bind(1, node, rest[static_cast<std::size_t>(node)]);
    }
    const std::vector<glm::mat4> world = bind_world(model);
    for (std::size_t node = 0; node < rest.size(); ++node) {
        EXPECT_LT(glm::length(glm::vec3(world[node][3] - rest[node][3])), 1e-4F) << node;
    }
}

TEST(StandingBody, arms_are_brought_level_and_legs_down) {
    Model model = raks::test::small_figure();
    for (const int arm : {6, 12}) {  // an A-pose
        const float side = arm == 6 ? 1.0F : -1.0F;
        model.nodes[static_cast<std::size_t>(arm)].rotation =
            glm::angleAxis(-0.8F * side, glm::vec3(0.0F, 0.0F, 1.0F));
    }
    ASSERT_TRUE(map_humanoid(model));
    const StandingBody standing = stand_up(model);
    for (const Bone bone : {Bone::left_upper_arm, Bone::right_lower_arm}) {
        const Bone child = bone == Bone::left_upper_arm ? Bone::left_lower_arm : Bone::right_hand;
        const glm::vec3 along = standing.straighten[motion::index_of(bone)] *
                                (place(standing, model, child) - place(standing, model, bone));
        EXPECT_NEAR(std::abs(along.x), glm::length(along), 1e-4F);
        EXPECT_EQ(along.x > 0.0F, bone == Bone::left_upper_arm);
    }
    const glm::quat still = standing.straighten[motion::index_of(Bone::spine)];
    EXPECT_FLOAT_EQ(still.w, 1.0F);
    EXPECT_NEAR(standing.straighten[motion::index_of(Bone::left_upper_leg)].w, 1.0F, 1e-4F);
}

TEST(StandingBody, faces_plus_z) {
    for (const float yaw : {0.5F, 1.5708F, 3.1F}) {
        Model model = raks::test::small_figure();
        model.nodes[0].rotation = glm::angleAxis(yaw, glm::vec3(0.0F, 1.0F, 0.0F));
        ASSERT_TRUE(map_humanoid(model));
        const StandingBody standing = stand_up(model);
        const glm::vec3 across = place(standing, model, Bone::left_upper_leg) -
                                 place(standing, model, Bone::right_upper_leg);
        EXPECT_NEAR(across.x, 0.2F, 1e-4F);
        EXPECT_NEAR(across.z, 0.0F, 1e-4F);
    }
}

TEST(StandingBody, of_vrm_is_as_stored_and_of_0_turned_by_half) {
    Model model = raks::test::read_vrm0_text().model;
    model.nodes[0].translation.x = 0.5F;
    const StandingBody standing = stand_up(model);
    EXPECT_NEAR(standing.world[0][3].x, -0.5F, 1e-6F);
    EXPECT_FLOAT_EQ(standing.straighten[motion::index_of(Bone::left_upper_arm)].w, 1.0F);
}

TEST(StandingBody, is_scaled_where_it_is_no_persons_size) {
    Model model = raks::test::small_figure();
    ASSERT_TRUE(map_humanoid(model));
    model.nodes[2].mesh = -1;
    EXPECT_FLOAT_EQ(stand_up(model).scale, 1.0F);
    EXPECT_TRUE(model.warnings.empty());
    EXPECT_NEAR(stand_up(model, 1.0F).scale * stand_up(model).height, 1.0F, 1e-5F);
    for (ModelNode& node : model.nodes) {
        node.translation *= 100.0F;
    }
    const StandingBody giant = stand_up(model);
    EXPECT_NEAR(giant.scale * giant.height, 1.7F, 1e-4F);
    EXPECT_TRUE(warns(model, "scaled to 1.7 m"));
}

TEST(StandingBody, feet_of_a_rig_are_moved_to_their_legs) {
    Model model;
    const int root = raks::test::add_node(model, "root", -1);
    Model small = raks::test::small_figure();
    for (const ModelNode& node : small.nodes) {
        const bool is_foot = node.name.find("Foot") != std::string::npos;
        const float side = node.name.rfind("left", 0) == 0 ? 1.0F : -1.0F;
        raks::test::add_node(model,
                             node.name,
                             is_foot || node.parent < 0 ? root : node.parent + 1,
                             is_foot ? glm::vec3(0.1F * side, 0.05F, 0.0F) : node.translation);
    }
    ASSERT_TRUE(map_humanoid(model));
    const int foot = node_of_bone(model, Bone::left_foot);
    EXPECT_EQ(model.nodes[static_cast<std::size_t>(foot)].parent, root);
    const StandingBody standing = stand_up(model);
    EXPECT_EQ(standing.parents[static_cast<std::size_t>(foot)],
              node_of_bone(model, Bone::left_lower_leg));
    EXPECT_TRUE(warns(model, "does not lie below the leftLowerLeg; it is moved there"));
}

}  // namespace
