#include "render/avatar/joint_tree.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

// Nodes in an order in which a child comes before its parent.
Model child_first_model() {
    Model model;
    model.nodes.resize(3);
    model.nodes[0].name = "tip";
    model.nodes[0].parent = 2;
    model.nodes[0].translation = {0, 1, 0};
    model.nodes[1].name = "root";
    model.nodes[1].children = {2};
    model.nodes[1].translation = {1, 0, 2};
    model.nodes[2].name = "middle";
    model.nodes[2].parent = 1;
    model.nodes[2].children = {0};
    model.nodes[2].rotation = turn_about_z(0.5F);
    model.roots = {1};
    return model;
}

TEST(JointTree, parents_come_first_whatever_the_order_of_the_nodes) {
    const JointTree tree = build_joint_tree(child_first_model());
    ASSERT_EQ(tree.joints.size(), 3U);
    EXPECT_EQ(tree.joints[0].name, "root");
    EXPECT_EQ(tree.joints[1].name, "middle");
    EXPECT_EQ(tree.joints[2].name, "tip");
    EXPECT_EQ(tree.joint_of(0), 2);
    EXPECT_EQ(tree.joint_of(1), 0);
    EXPECT_EQ(tree.nodes, (std::vector<int>{1, 2, 0}));
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
        EXPECT_LT(tree.joints[i].parent, static_cast<int>(i));
    }
}

TEST(JointTree, nodes_outside_of_the_scene_are_no_joints_unless_a_skin_needs_them) {
    Model model = child_first_model();
    const int hidden = add_node(model, "hidden", -1, {});
    const int skinned = add_node(model, "skinned", -1, {});
    model.roots = {1};
    ModelSkin skin;
    skin.joints = {skinned};
    skin.inverse_bind = {glm::mat4(1.0F)};
    model.skins.push_back(skin);
    const JointTree tree = build_joint_tree(model);
    EXPECT_EQ(tree.joint_of(hidden), -1);
    EXPECT_EQ(tree.joint_of(skinned), 3);
    EXPECT_EQ(tree.joint_of(-1), -1);
}

TEST(JointTree, a_model_that_faces_minus_z_is_turned_by_half_a_turn_and_scaled) {
    Model model = child_first_model();
    const glm::vec3 before(rest_state(build_joint_tree(model).joints).world[2][3]);
    model.character.faces_minus_z = true;
    const glm::vec3 after(rest_state(build_joint_tree(model, 2.0F).joints).world[2][3]);
    EXPECT_NEAR(after.x, -2.0F * before.x, 1e-6F);
    EXPECT_NEAR(after.y, 2.0F * before.y, 1e-6F);
    EXPECT_NEAR(after.z, -2.0F * before.z, 1e-6F);
}

TEST(JointTree, the_world_of_one_joint_is_that_of_the_whole_update) {
    const JointTree tree = build_joint_tree(crooked_humanoid_model());
    const JointState state = rest_state(tree.joints);
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
        const glm::mat4 alone = compute_world(tree.joints, state, i);
        EXPECT_LT(glm::distance(alone[3], state.world[i][3]), 1e-5F) << tree.joints[i].name;
    }
}

TEST(JointTree, the_shortest_turn_takes_one_direction_to_the_other) {
    const glm::vec3 x(1, 0, 0);
    for (const glm::vec3& to : {glm::vec3(0, 1, 0),
                                glm::vec3(1, 0, 0),
                                glm::vec3(-1, 0, 0),
                                glm::normalize(glm::vec3(-1, 1e-4F, 0)),
                                glm::normalize(glm::vec3(1, 2, -3))}) {
        EXPECT_LT(glm::distance(shortest_turn(x, to) * x, to), 2e-3F) << to.x << " " << to.y;
        EXPECT_NEAR(glm::length(shortest_turn(x, to)), 1.0F, 1e-5F);
    }
}

}  // namespace
}  // namespace raks::render
