#include "render/avatar/humanoid_rig.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models
using motion::Bone;

motion::Pose wild_pose() {
    motion::Pose pose;
    const CounterRandom random(3);
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        const glm::vec3 axis(
            random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
        pose.local_rotations[i] = glm::angleAxis(0.6F, glm::normalize(axis));
    }
    pose.hips_position = {0.3F, 0.8F, -0.2F};
    return pose;
}

struct Posed {
    JointTree tree;
    JointState state;
};

Posed posed(const Model& model, const motion::Pose& pose, float hips_scale = 1.0F) {
    Posed result;
    result.tree = build_joint_tree(model);
    result.state = rest_state(result.tree.joints);
    const HumanoidRig rig = HumanoidRig::build(result.tree, model.character.humanoid, result.state);
    rig.apply(pose, hips_scale, result.state);
    update_world(result.tree.joints, result.state);
    return result;
}

glm::vec3 place(const Posed& posed, const Model& model, Bone bone) {
    const int node = model.character.humanoid.nodes[motion::index_of(bone)];
    return glm::vec3(posed.state.world[static_cast<std::size_t>(posed.tree.joint_of(node))][3]);
}

void expect_places_of_the_skeleton(const Model& model, float turn_sign) {
    const motion::Pose pose = wild_pose();
    const motion::WorldPose expected = motion::world_pose(motion::mannequin_skeleton(), pose);
    const Posed result = posed(model, pose);
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        const auto bone = static_cast<Bone>(i);
        EXPECT_LT(glm::distance(place(result, model, bone), expected.position(bone)), 1e-5F)
            << motion::kBoneNames[i] << " " << turn_sign;
    }
}

TEST(HumanoidRig, a_model_of_the_built_in_skeleton_stands_as_the_skeleton_does) {
    expect_places_of_the_skeleton(humanoid_model(), 1.0F);
}

TEST(HumanoidRig, rest_rotations_of_the_model_do_not_show) {
    expect_places_of_the_skeleton(crooked_humanoid_model(), 1.0F);
}

TEST(HumanoidRig, a_model_that_faces_backwards_dances_as_all_others) {
    Model model = humanoid_model();
    for (ModelNode& node : model.nodes) {
        node.translation.x = -node.translation.x;
        node.translation.z = -node.translation.z;
    }
    model.character.faces_minus_z = true;
    expect_places_of_the_skeleton(model, -1.0F);
}

TEST(HumanoidRig, nodes_above_the_hips_do_not_show) {
    Model model = crooked_humanoid_model();
    const int root = add_node(model, "armature", -1, {0.1F, 0.2F, 0.3F}, turn_about_x(-1.0F));
    model.roots = {root};
    model.nodes[0].parent = root;
    model.nodes[static_cast<std::size_t>(root)].children = {0};
    model.nodes[0].rotation = turn_about_x(1.0F) * model.nodes[0].rotation;
    expect_places_of_the_skeleton(model, 1.0F);
}

TEST(HumanoidRig, rotations_of_lacking_bones_go_into_the_next_ones) {
    Model model = humanoid_model();
    model.character.humanoid.nodes[motion::index_of(Bone::chest)] = -1;
    model.character.humanoid.nodes[motion::index_of(Bone::upper_chest)] = -1;
    motion::Pose pose;
    pose.rotation(Bone::chest) = turn_about_x(0.3F);
    pose.rotation(Bone::upper_chest) = turn_about_y(0.4F);
    pose.rotation(Bone::neck) = turn_about_z(0.5F);
    const Posed result = posed(model, pose);
    const glm::quat expected = turn_about_x(0.3F) * turn_about_y(0.4F) * turn_about_z(0.5F);
    EXPECT_TRUE(
        is_same_rotation(rotation_of(result.state.world[motion::index_of(Bone::neck)]), expected));
    EXPECT_TRUE(is_same_rotation(rotation_of(result.state.world[motion::index_of(Bone::chest)]),
                                 motion::kNoRotation));
    // Both shoulders hang from the chest, so both take its rotations.
    EXPECT_TRUE(
        is_same_rotation(rotation_of(result.state.world[motion::index_of(Bone::left_shoulder)]),
                         turn_about_x(0.3F) * turn_about_y(0.4F)));
}

TEST(HumanoidRig, the_hips_travel_by_the_ratio_of_heights) {
    motion::Pose pose;
    pose.hips_position = {1.0F, 0.9F, -2.0F};
    const Model model = humanoid_model();
    const glm::vec3 hips = place(posed(model, pose, 0.5F), model, Bone::hips);
    EXPECT_LT(glm::distance(hips, glm::vec3(0.5F, 0.45F, -1.0F)), 1e-6F);
}

TEST(HumanoidRig, bones_that_are_lacking_lie_where_they_would_hang) {
    Model model = humanoid_model();
    model.character.humanoid.nodes[motion::index_of(Bone::upper_chest)] = -1;
    const JointTree tree = build_joint_tree(model);
    const HumanoidRig rig =
        HumanoidRig::build(tree, model.character.humanoid, rest_state(tree.joints));
    EXPECT_EQ(rig.joint(Bone::upper_chest), -1);
    EXPECT_EQ(rig.rest_places()[motion::index_of(Bone::upper_chest)],
              rig.rest_places()[motion::index_of(Bone::chest)]);
}

TEST(HumanoidRig, posing_is_real_time_safe) {
    const Model model = crooked_humanoid_model();
    const JointTree tree = build_joint_tree(model);
    JointState state = rest_state(tree.joints);
    const HumanoidRig rig = HumanoidRig::build(tree, model.character.humanoid, state);
    const motion::Pose pose = wild_pose();
    raks::test::RealtimeScope scope;
    rig.apply(pose, 1.0F, state);
    update_world(tree.joints, state);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
