#include "render/avatar/node_constraints.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

// Three nodes beside each other, each with a rest rotation of its own.
struct ConstraintBench {
    Model model;
    JointTree tree;
    JointState state;
    std::vector<std::string> warnings;
    NodeConstraints constraints;

    ConstraintBench() {
        add_node(model, "a", -1, {0, 0, 0}, turn_about_x(0.3F));
        add_node(model, "b", -1, {1, 0, 0}, turn_about_y(0.5F));
        add_node(model, "c", -1, {2, 1, 0}, turn_about_z(0.7F));
        tree = build_joint_tree(model);
        state = rest_state(tree.joints);
    }
    void build(const std::vector<NodeConstraint>& all) {
        constraints = NodeConstraints::build(tree, all, state, warnings);
    }
    void apply() {
        constraints.apply(tree.joints, state);
        update_world(tree.joints, state);
    }
};

TEST(NodeConstraints, a_rotation_is_taken_over_from_rest_by_its_weight) {
    ConstraintBench bench;
    bench.build({{.node = 1, .source = 0, .weight = 0.5F}});
    bench.state.rotations[0] = bench.state.rotations[0] * turn_about_z(0.8F);
    bench.apply();
    EXPECT_TRUE(
        is_same_rotation(bench.state.rotations[1], turn_about_y(0.5F) * turn_about_z(0.4F)));
    EXPECT_TRUE(bench.warnings.empty());
}

TEST(NodeConstraints, at_rest_nothing_turns) {
    for (const ConstraintKind kind : {ConstraintKind::rotation, ConstraintKind::roll}) {
        ConstraintBench bench;
        bench.build({{.node = 1, .source = 0, .kind = kind, .axis = NodeAxis::y}});
        bench.apply();
        EXPECT_TRUE(is_same_rotation(bench.state.rotations[1], turn_about_y(0.5F)));
    }
}

TEST(NodeConstraints, a_roll_takes_the_twist_and_leaves_the_swing) {
    ConstraintBench bench;
    // Both at rest without rotation, so that the axes are the same.
    bench.state.rotations[0] = motion::kNoRotation;
    bench.state.rotations[1] = motion::kNoRotation;
    bench.build({{.node = 1, .source = 0, .kind = ConstraintKind::roll, .axis = NodeAxis::x}});
    bench.state.rotations[0] = turn_about_z(0.6F) * turn_about_x(0.9F);
    bench.apply();
    EXPECT_TRUE(is_same_rotation(bench.state.rotations[1], turn_about_x(0.9F)));
}

TEST(NodeConstraints, an_aim_points_its_axis_at_the_source) {
    for (const NodeAxis axis : {NodeAxis::x, NodeAxis::minus_z, NodeAxis::y}) {
        ConstraintBench bench;
        bench.build({{.node = 0, .source = 2, .kind = ConstraintKind::aim, .axis = axis}});
        bench.apply();
        const glm::vec3 local = axis == NodeAxis::x         ? glm::vec3(1, 0, 0)
                                : axis == NodeAxis::minus_z ? glm::vec3(0, 0, -1)
                                                            : glm::vec3(0, 1, 0);
        const glm::vec3 shown = bench.state.rotations[0] * local;
        EXPECT_LT(glm::distance(shown, glm::normalize(glm::vec3(2, 1, 0))), 1e-5F);
    }
}

TEST(NodeConstraints, an_aim_at_its_own_place_leaves_the_joint_at_rest) {
    ConstraintBench bench;
    add_node(bench.model, "same place", -1, {0, 0, 0});
    bench.tree = build_joint_tree(bench.model);
    bench.state = rest_state(bench.tree.joints);
    bench.build({{.node = 0, .source = 3, .kind = ConstraintKind::aim}});
    bench.apply();
    EXPECT_TRUE(is_same_rotation(bench.state.rotations[0], turn_about_x(0.3F)));
}

TEST(NodeConstraints, sources_come_first_whatever_the_order) {
    ConstraintBench bench;
    bench.build({{.node = 2, .source = 1}, {.node = 1, .source = 0}});
    bench.state.rotations[0] = bench.state.rotations[0] * turn_about_z(0.8F);
    bench.apply();
    EXPECT_TRUE(
        is_same_rotation(bench.state.rotations[2], turn_about_z(0.7F) * turn_about_z(0.8F)));
}

TEST(NodeConstraints, a_circle_is_opened_with_a_warning_and_the_rest_is_kept) {
    ConstraintBench bench;
    bench.build({{.node = 0, .source = 1}, {.node = 1, .source = 2}, {.node = 2, .source = 0}});
    EXPECT_EQ(bench.constraints.size(), 2U);
    ASSERT_EQ(bench.warnings.size(), 1U);
    EXPECT_EQ(bench.warnings[0],
              "the constraint of node 2 is left out: it waits for itself in a circle");
}

TEST(NodeConstraints, what_cannot_be_built_is_left_out_and_said) {
    ConstraintBench bench;
    bench.model.roots = {0, 1};
    bench.tree = build_joint_tree(bench.model);
    bench.state = rest_state(bench.tree.joints);
    bench.build({{.node = 0, .source = 0},
                 {.node = 1, .source = 2},
                 {.node = 1, .source = 0},
                 {.node = 1, .source = 0, .kind = ConstraintKind::roll}});
    EXPECT_EQ(bench.constraints.size(), 1U);
    EXPECT_EQ(
        bench.warnings,
        (std::vector<std::string>{
            "the constraint of node 1 is left out: its node or its source is not in the scene",
            "the constraint of node 1 is left out: the node has another one",
            "the constraint of node 0 is left out: it waits for itself in a circle",
        }));
}

TEST(NodeConstraints, applying_is_real_time_safe) {
    ConstraintBench bench;
    bench.build({{.node = 0, .source = 2, .kind = ConstraintKind::aim},
                 {.node = 1, .source = 0, .kind = ConstraintKind::roll}});
    raks::test::RealtimeScope scope;
    bench.apply();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
