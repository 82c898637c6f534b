// Figures that other programs build in ways of their own: the same bones are found in each, by the
// avatar's finder and in its clip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "motion/skeleton/body/body_finder.hpp"
#include "render/import/bind_places.hpp"
#include "render/import/body_parents.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_motion.hpp"
#include "render/import/standing_body.hpp"
#include "tests/render/import/skinned_figure.hpp"

namespace raks::render::figure_finder_test {
namespace {

using motion::Bone;

Bone bone_named(const std::string& name) {
    return static_cast<Bone>(std::find(motion::kBoneNames.begin(), motion::kBoneNames.end(), name) -
                             motion::kBoneNames.begin());
}

std::string found(const Model& model, Bone bone) {
    const int node = model.character.humanoid.nodes[motion::index_of(bone)];
    return node < 0 ? "-" : model.nodes[static_cast<std::size_t>(node)].name;
}

bool warns(const Model& model, std::string_view words) {
    return raks::test::ReadFigure{.model = model, .error = {}}.warns(words);
}

/// The figure without the nodes whose names hold `part`, which carry nothing.
Model without(const Model& model, const std::string& part) {
    Model less;
    std::map<int, int> at;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const ModelNode& node = model.nodes[i];
        if (node.name.find(part) == std::string::npos) {
            at[static_cast<int>(i)] = raks::test::add_node(
                less, node.name, node.parent < 0 ? -1 : at[node.parent], node.translation);
        }
    }
    return less;
}

/// A node in the middle of the way to `node`, which hangs on it from then on.
void insert_helper(Model& model, const std::string& name) {
    const int node = raks::test::node_named(model, name);
    const auto at = static_cast<std::size_t>(node);
    const int parent = model.nodes[at].parent;
    const int helper =
        raks::test::add_node(model, name + "Helper", parent, 0.5F * model.nodes[at].translation);
    model.nodes[at].translation *= 0.5F;
    model.nodes[at].parent = helper;
    std::erase(model.nodes[static_cast<std::size_t>(parent)].children, node);
    model.nodes[static_cast<std::size_t>(helper)].children.push_back(node);
}

const char* const kLimbBones[] = {"UpperLeg", "LowerLeg", "Foot", "UpperArm", "LowerArm", "Hand"};

/// Whether a figure of nameless joints is found as it was built: `names`, by node, are its bones.
void expect_found_without_names(Model model) {
    std::map<std::string, std::string> names;
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        names["Bone." + std::to_string(node)] = model.nodes[node].name;
    }
    raks::test::forget_names(model);
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    for (const char* const side : {"left", "right"}) {
        for (const char* const part : kLimbBones) {
            const Bone bone = bone_named(std::string(side) + part);
            const std::string node = found(model, bone);
            if (node != "-") {
                EXPECT_EQ(names[node], std::string(side) + part);
            } else {
                EXPECT_STREQ(part, "Hand");
            }
        }
    }
    EXPECT_EQ(names[found(model, Bone::hips)], "hips");
    EXPECT_EQ(names[found(model, Bone::head)], "head");
}

TEST(FigureFinder, hands_may_be_missing) {
    Model model = without(raks::test::figure_of_joints(), "Hand");
    auto flesh = raks::test::flesh_of_figure(model);
    flesh[static_cast<std::size_t>(raks::test::node_named(model, "leftLowerArm"))] = {0.43F, 0, 0};
    flesh[static_cast<std::size_t>(raks::test::node_named(model, "rightLowerArm"))] = {
        -0.43F, 0, 0};
    raks::test::add_skin(model, flesh);
    expect_found_without_names(model);
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_lower_arm), "leftLowerArm");
    EXPECT_EQ(found(model, Bone::left_hand), "-");
    EXPECT_EQ(missing_bones(model.character.humanoid), "");
    EXPECT_EQ(missing_bones(model.character.humanoid, kRequiredBones), "leftHand, rightHand");
}

/// The figure whose spine is the root, with the hips and both legs below it.
Model with_low_hips() {
    Model model = raks::test::figure_of_joints();
    ModelNode& hips = model.nodes[0];
    ModelNode& spine = model.nodes[1];
    spine.parent = -1;
    spine.translation += hips.translation;
    hips.translation -= spine.translation;
    hips.parent = 1;
    std::erase(hips.children, 1);
    spine.children.push_back(0);
    model.roots = {1};
    return model;
}

TEST(FigureFinder, hips_may_hang_under_the_trunk) {
    Model model = with_low_hips();
    const std::vector<glm::mat4> truth = rest_world(raks::test::figure_of_joints());
    raks::test::add_skin(model, raks::test::flesh_of_figure(model));
    expect_found_without_names(model);
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::hips), "hips");
    EXPECT_EQ(found(model, Bone::spine), "spine");
    const StandingBody standing = stand_up(model);
    EXPECT_EQ(standing.parents[0], -1);
    EXPECT_EQ(standing.parents[1], 0);
    EXPECT_TRUE(warns(model, "\"spine\" (spine) does not lie below the hips"));
    for (std::size_t node = 0; node < truth.size(); ++node) {
        EXPECT_LT(glm::distance(glm::vec3(standing.world[node][3]), glm::vec3(truth[node][3])),
                  1e-4F);
    }
}

TEST(FigureFinder, helper_joints_lie_between_bones) {
    Model model = raks::test::figure_of_joints();
    for (const char* const side : {"left", "right"}) {
        for (const char* const part : {"LowerLeg", "Foot", "LowerArm", "Hand"}) {
            insert_helper(model, std::string(side) + part);
        }
    }
    raks::test::add_skin(model, raks::test::flesh_of_figure(model));
    expect_found_without_names(model);
}

TEST(FigureFinder, collar_bones_are_no_upper_arms) {
    Model model = raks::test::figure_of_joints();
    for (const float side : {1.0F, -1.0F}) {
        const char letter = side > 0.0F ? 'L' : 'R';
        const std::string word = side > 0.0F ? "left" : "right";
        const auto named = [letter](const std::string& name) {
            return letter + std::string("_") + name + "_bind_JNT";
        };
        const int arm = raks::test::node_named(model, word + "UpperArm");
        insert_helper(model, word + "UpperArm");
        ModelNode& collar = model.nodes[static_cast<std::size_t>(
            raks::test::node_named(model, word + "UpperArmHelper"))];
        collar.name = named("clavicle");
        collar.translation.x = 0.02F * side;
        model.nodes[static_cast<std::size_t>(arm)].translation.x = 0.13F * side;
        for (const auto& [from, to] :
             {std::pair<const char*, const char*>("UpperArm", "armUpper0001"),
              {"LowerArm", "armLower0001"},
              {"Hand", "hand0001"}}) {
            model.nodes[static_cast<std::size_t>(raks::test::node_named(model, word + from))].name =
                named(to);
        }
    }
    raks::test::add_skin(model,
                         raks::test::flesh_to_children(model,
                                                       {{"head", {0, 0.15F, 0}},
                                                        {"L_hand", {0.18F, 0, 0}},
                                                        {"R_hand", {-0.18F, 0, 0}},
                                                        {"Toes", {0, -0.01F, 0.07F}}}));
    Model nameless = model;
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_shoulder), "L_clavicle_bind_JNT");
    EXPECT_EQ(found(model, Bone::left_upper_arm), "L_armUpper0001_bind_JNT");
    EXPECT_EQ(found(model, Bone::right_lower_arm), "R_armLower0001_bind_JNT");
    EXPECT_EQ(found(model, Bone::right_hand), "R_hand0001_bind_JNT");
    EXPECT_GT(model.character.humanoid.confidence[motion::index_of(Bone::left_upper_arm)], 0.9F);
    raks::test::forget_names(nameless);
    ASSERT_TRUE(map_humanoid(nameless));
    EXPECT_EQ(nameless.character.humanoid.nodes, model.character.humanoid.nodes);
}

TEST(FigureFinder, the_target_of_a_pole_is_no_elbow) {
    Model model = raks::test::figure_of_joints();
    auto flesh = raks::test::flesh_of_figure(model);
    for (const char* const name : {"elbow.L", "elbow.R", "knee.L", "knee.R"}) {
        raks::test::add_node(
            model, name, -1, {name[name[0] == 'e' ? 6 : 5] == 'L' ? 0.4F : -0.4F, 1.2F, -0.5F});
        flesh.emplace_back(0.0F);
    }
    for (ModelNode& node : model.nodes) {
        if (node.name.find("Lower") != std::string::npos) {
            node.name = "joint" + node.name.substr(0, 1) + node.name.substr(node.name.size() - 3);
        }
    }
    raks::test::add_skin(model, flesh);
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_lower_arm), "jointlArm");
    EXPECT_EQ(found(model, Bone::right_lower_leg), "jointrLeg");
}

TEST(FigureFinder, names_against_the_picture_give_way_to_it) {
    // Names as a joke: the upper arm is called the hand, and so on.
    Model model = raks::test::skinned_figure();
    for (const char* const side : {"left", "right"}) {
        const std::string word = side;
        const auto node = [&](const char* part) -> std::string& {
            return model.nodes[static_cast<std::size_t>(raks::test::node_named(model, word + part))]
                .name;
        };
        std::string& upper = node("UpperArm");
        std::string& hand = node("Hand");
        std::swap(upper, hand);
    }
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_upper_arm), "leftHand");
    EXPECT_EQ(found(model, Bone::left_hand), "leftUpperArm");
    EXPECT_TRUE(
        warns(model, "its left arm is found by its place in the skeleton, not by its names"));
}

TEST(FigureFinder, what_the_picture_contradicts_is_doubtful_and_said) {
    // Arms of two lengths, so that the shape knows no arms; both begin on the middle line.
    Model model = raks::test::figure_of_joints();
    for (const float side : {1.0F, -1.0F}) {
        const std::string word = side > 0.0F ? "left" : "right";
        model.nodes[static_cast<std::size_t>(raks::test::node_named(model, word + "UpperArm"))]
            .translation.x = 0.01F * side;
    }
    model.nodes[static_cast<std::size_t>(raks::test::node_named(model, "rightHand"))]
        .translation.x = -0.5F;
    raks::test::add_skin(model, raks::test::flesh_of_figure(model));
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    const auto& confidence = model.character.humanoid.confidence;
    EXPECT_LT(confidence[motion::index_of(Bone::left_upper_arm)], 0.7F);
    EXPECT_GE(confidence[motion::index_of(Bone::left_upper_leg)], 0.7F);
    EXPECT_TRUE(warns(
        model, "its left arm is doubtful: \"leftUpperArm\" (leftUpperArm) lies inside the chest"));
}

TEST(FigureFinder, goals_for_feet_say_nothing_of_sides_and_are_doubtful) {
    // Legs of two joints; what is called a foot is a rig's goal behind the figure, with flesh that
    // points back.
    Model model;
    const int root = raks::test::add_node(model, "root", -1);
    const Model whole = raks::test::figure_of_joints();
    for (const ModelNode& node : whole.nodes) {
        if (node.name.find("Toes") != std::string::npos) {
            continue;
        }
        const bool is_foot = node.name.find("Foot") != std::string::npos;
        const float side = node.name.rfind("left", 0) == 0 ? 1.0F : -1.0F;
        const int parent =
            node.parent < 0 || is_foot
                ? root
                : raks::test::node_named(model,
                                         whole.nodes[static_cast<std::size_t>(node.parent)].name);
        raks::test::add_node(model,
                             node.name,
                             parent,
                             is_foot ? glm::vec3(0.1F * side, 0.05F, -0.6F) : node.translation);
    }
    auto flesh = raks::test::flesh_of_figure(model);
    for (const char* const foot : {"leftFoot", "rightFoot"}) {
        flesh[static_cast<std::size_t>(raks::test::node_named(model, foot))] = {0, 0, -0.2F};
    }
    raks::test::add_skin(model, flesh);
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_upper_leg), "leftUpperLeg");
    EXPECT_FALSE(warns(model, "named the wrong way round"));
    EXPECT_LT(model.character.humanoid.confidence[motion::index_of(Bone::left_foot)], 0.7F);
}

TEST(FigureFinder, what_a_hand_carries_is_no_forearm) {
    // French: arm, hand, weapon.
    Model model = raks::test::figure_of_joints();
    for (const auto& [side, word] : {std::pair("left", "gauche"), std::pair("right", "droite")}) {
        for (const auto& [part, name] : {std::pair("UpperArm", "bras "),
                                         std::pair("LowerArm", "main "),
                                         std::pair("Hand", "arme ")}) {
            const int node = raks::test::node_named(model, std::string(side) + part);
            model.nodes[static_cast<std::size_t>(node)].name = std::string(name) + word;
        }
    }
    const auto mapped = map_humanoid(model);
    ASSERT_TRUE(mapped) << mapped.error().message;
    EXPECT_EQ(found(model, Bone::left_upper_arm), "bras gauche");
    EXPECT_EQ(found(model, Bone::left_lower_arm), "main gauche");
    EXPECT_EQ(found(model, Bone::right_lower_arm), "main droite");
}

/// A clip that bends the left elbow and turns the trunk.
void add_clip(Model& model) {
    ModelAnimation& clip = model.animations.emplace_back();
    clip.name = "bend";
    for (const char* const name : {"leftLowerArm", "spine"}) {
        AnimationChannel& channel = clip.channels.emplace_back();
        channel.node = raks::test::node_named(model, name);
        channel.path = ChannelPath::rotation;
        channel.times = {0.0F, 1.0F};
        const float half = std::sqrt(0.5F);
        channel.values = {0, 0, 0, 1, 0, -half, 0, half};
    }
}

TEST(FigureFinder, the_clip_of_a_model_has_its_bones_its_height_and_its_facing) {
    Model turned = raks::test::figure_of_joints();
    turned.nodes[0].rotation = glm::angleAxis(glm::radians(90.0F), glm::vec3(0.0F, 1.0F, 0.0F));
    for (Model model : {raks::test::figure_of_joints(), with_low_hips(), turned}) {
        add_clip(model);
        raks::test::add_skin(model, raks::test::flesh_of_figure(model));
        ASSERT_TRUE(map_humanoid(model));
        const auto moved = model_clip(model, 0, 30.0);
        ASSERT_TRUE(moved) << moved.error().message;
        const auto body = motion::find_body(moved->clip);
        ASSERT_TRUE(body) << body.error().message;
        for (int i = 0; i < motion::kBoneCount; ++i) {
            const Bone bone = static_cast<Bone>(i);
            const auto joint = body->mapping().joint(bone);
            EXPECT_EQ(joint ? moved->clip.joints[*joint].name : "-", found(model, bone));
        }
        const ModelSurvey measured = survey(model);
        EXPECT_NEAR(body->size.height, measured.box->high.y - measured.box->low.y, 1e-4);
        EXPECT_NEAR(body->stance.facing, measured.facing_degrees.value(), 1e-3);
        // Where its joints are is what the nodes' own worlds say, however they hang together.
        const motion::ClipWorldPose world = motion::world_pose(moved->clip, 0);
        const std::vector<glm::mat4> rest = rest_world(model);
        for (std::size_t joint = 0; joint < moved->nodes.size(); ++joint) {
            EXPECT_LT(
                glm::distance(world.positions[joint], glm::dvec3(rest[moved->nodes[joint]][3])),
                1e-5);
        }
    }
}

TEST(FigureFinder, parents_of_a_body_have_no_loop_and_come_first) {
    Model model = with_low_hips();
    ASSERT_TRUE(map_humanoid(model));
    const std::vector<int> parents = body_parents(model).parents;
    const std::vector<std::size_t> order = parents_first(parents);
    ASSERT_EQ(order.size(), parents.size());
    std::vector<bool> is_done(parents.size(), false);
    for (const std::size_t node : order) {
        EXPECT_TRUE(parents[node] < 0 || is_done[static_cast<std::size_t>(parents[node])]);
        is_done[node] = true;
    }
}

}  // namespace
}  // namespace raks::render::figure_finder_test
