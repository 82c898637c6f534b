#include "render/avatar/spring_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

struct SpringBench {
    JointTree tree;
    JointState state;
    std::vector<std::string> warnings;
    SpringRig rig;
    SpringTails tails;

    explicit SpringBench(const Model& model) : tree(build_joint_tree(model)) {
        state = rest_state(tree.joints);
        rig = SpringRig::build(tree, model.character, state, warnings);
        tails = rig.make_tails();
        rig.rest(tree.joints, state, tails);
    }
    void step() {
        update_world(tree.joints, state);
        rig.step(tree.joints, state, tails);
    }
    void move_root(const glm::vec3& to) { state.translations[0] = to; }
    glm::vec3 tip() { return rig.tail_place(rig.size() - 1, state); }
    void expect_lengths_kept() {
        for (std::size_t i = 0; i < rig.size(); ++i) {
            const glm::vec3 origin(state.world[rig.joint(i)][3]);
            EXPECT_NEAR(glm::distance(rig.tail_place(i, state), origin), rig.length(i), 1e-5F);
        }
    }
};

// A chain of `count` joints that hangs along -y from 1 m above the floor, 0.1 m a joint.
Model rope(int count = 4) { return hanging_chain({0, 1, 0}, {0, -0.1F, 0}, count); }

SpringJoint& joint_of(Model& model, std::size_t i) { return model.character.springs[0].joints[i]; }

TEST(SpringRig, at_rest_nothing_moves) {
    SpringBench bench(rope());
    const glm::vec3 before = bench.tip();
    for (int i = 0; i < 100; ++i) {
        bench.step();
    }
    EXPECT_LT(glm::distance(bench.tip(), before), 1e-5F);
    EXPECT_TRUE(bench.warnings.empty());
}

TEST(SpringRig, one_step_of_one_joint_is_the_formula_of_the_specification) {
    Model model = rope(2);
    SpringJoint& joint = joint_of(model, 0);
    joint.stiffness = 0.7F;
    joint.gravity_power = 0.3F;
    joint.gravity_direction = {1, 0, 0};
    joint.drag = 0.4F;
    SpringBench bench(model);
    bench.tails.current[0] = {0.05F, 0.92F, 0.01F};
    bench.tails.previous[0] = {0.04F, 0.93F, 0.0F};
    bench.move_root({0.02F, 1.01F, 0});
    bench.step();

    const glm::vec3 current(0.05F, 0.92F, 0.01F);
    const glm::vec3 inertia = (current - glm::vec3(0.04F, 0.93F, 0.0F)) * 0.6F;
    const glm::vec3 origin(0.02F, 1.01F, 0);
    const glm::vec3 pushed = current + inertia + glm::vec3(0, -1, 0) * (0.7F / 60.0F) +
                             glm::vec3(1, 0, 0) * (0.3F / 60.0F);
    const glm::vec3 expected = origin + glm::normalize(pushed - origin) * 0.1F;
    EXPECT_LT(glm::distance(bench.tails.current[0], expected), 1e-6F);
    EXPECT_EQ(bench.tails.previous[0], current);
    EXPECT_LT(glm::distance(bench.rig.tail_place(0, bench.state), expected), 1e-6F);
}

TEST(SpringRig, length_is_kept_in_quick_turns) {
    SpringBench bench(rope(6));
    for (int i = 0; i < 120; ++i) {
        bench.state.rotations[0] = turn_about_z(std::sin(0.3F * static_cast<float>(i)));
        bench.move_root({std::sin(0.5F * static_cast<float>(i)), 1, 0});
        bench.step();
        bench.expect_lengths_kept();
    }
}

TEST(SpringRig, gravity_lets_a_level_chain_hang_and_is_the_worlds) {
    Model model = hanging_chain({0, 1, 0}, {0.1F, 0, 0}, 4);
    for (SpringJoint& joint : model.character.springs[0].joints) {
        joint.stiffness = 0.0F;
        joint.gravity_power = 1.0F;
    }
    model.nodes[0].rotation = turn_about_z(0.8F);
    SpringBench bench(model);
    for (int i = 0; i < 600; ++i) {
        bench.step();
    }
    EXPECT_LT(glm::distance(bench.tip(), glm::vec3(0, 0.7F, 0)), 1e-3F);
}

TEST(SpringRig, motion_of_the_center_swings_nothing) {
    Model model = rope();
    model.character.springs[0].center = 0;
    SpringBench with_center(model);
    SpringBench without(rope());
    const glm::vec3 hanging(0, -0.3F, 0);
    float most_with = 0.0F;
    float most_without = 0.0F;
    for (int i = 1; i <= 30; ++i) {
        const glm::vec3 root(0.05F * static_cast<float>(i), 1, 0);
        for (SpringBench* bench : {&with_center, &without}) {
            bench->move_root(root);
            bench->step();
        }
        most_with = std::max(most_with, glm::distance(with_center.tip() - root, hanging));
        most_without = std::max(most_without, glm::distance(without.tip() - root, hanging));
    }
    EXPECT_LT(most_with, 1e-5F);
    EXPECT_GT(most_without, 0.05F);
}

TEST(SpringRig, tails_stay_out_of_colliders) {
    Model model = rope(5);
    const int post = add_node(model, "post", -1, {0.02F, 0.75F, 0});
    model.character.colliders.push_back({.node = post, .radius = 0.06F});
    model.character.springs[0].colliders = {0};
    for (SpringJoint& joint : model.character.springs[0].joints) {
        joint.hit_radius = 0.01F;
    }
    SpringBench bench(model);
    for (int i = 0; i < 200; ++i) {
        bench.step();
    }
    for (std::size_t i = 0; i < bench.rig.size(); ++i) {
        EXPECT_LT(bench.rig.depth(i, bench.state), 0.005F) << i;
    }
    bench.expect_lengths_kept();
}

TEST(SpringRig, the_last_joint_of_vrm_0_swings_about_a_tail_7_cm_further_on) {
    Model model = rope(3);
    model.character.springs[0].has_virtual_tail = true;
    SpringBench bench(model);
    ASSERT_EQ(bench.rig.size(), 3U);
    EXPECT_LT(glm::distance(bench.tip(), glm::vec3(0, 1.0F - 0.2F - 0.07F, 0)), 1e-6F);
}

TEST(SpringRig, sizes_of_the_node_scale_lengths_and_radii) {
    Model model = rope(3);
    model.nodes[0].scale = glm::vec3(3.0F);
    model.character.colliders.push_back({.node = 0, .offset = {0, 0, 0.02F}, .radius = 0.01F});
    model.character.springs[0].colliders = {0};
    SpringBench bench(model);
    EXPECT_NEAR(bench.rig.length(0), 0.3F, 1e-6F);
    bench.step();
    bench.expect_lengths_kept();
}

TEST(SpringRig, a_chain_that_is_not_finite_begins_anew) {
    SpringBench bench(rope());
    const glm::vec3 hanging = bench.tip();
    bench.move_root(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    bench.step();
    bench.move_root({0, 1, 0});
    bench.step();
    bench.step();
    EXPECT_LT(glm::distance(bench.tip(), hanging), 1e-5F);
    bench.tails.current[1] = glm::vec3(std::numeric_limits<float>::infinity());
    bench.step();
    EXPECT_LT(glm::distance(bench.tip(), hanging), 1e-5F);
}

TEST(SpringRig, a_leap_of_the_pose_throws_no_tail_faster_than_ten_metres_a_second) {
    Model model = rope();
    for (SpringJoint& joint : model.character.springs[0].joints) {
        joint.drag = 0.0F;
        joint.stiffness = 0.0F;
    }
    SpringBench bench(model);
    bench.tails.previous[0] = {-100, 0.9F, 0};
    bench.step();
    bench.expect_lengths_kept();
    // A sixth of a metre sideways, 0.1 m below the joint.
    const glm::vec3 expected =
        glm::vec3(0, 1, 0) + 0.1F * glm::normalize(glm::vec3(10.0F / 60.0F, -0.1F, 0));
    EXPECT_LT(glm::distance(bench.tails.current[0], expected), 1e-4F);
}

TEST(SpringRig, joints_between_and_behind_go_with_their_swing) {
    Model model;
    const int root = add_node(model, "root", -1, {0, 1, 0});
    const int first = add_node(model, "first", root, {0, 0, 0});
    const int between = add_node(model, "between", first, {0, -0.1F, 0}, turn_about_x(0.2F));
    const int second = add_node(model, "second", between, {0, -0.1F, 0});
    const int tip = add_node(model, "tip", second, {0, -0.1F, 0});
    const int ribbon = add_node(model, "ribbon", between, {0.1F, 0, 0});
    SpringChain chain;
    for (const int node : {first, second, tip}) {
        SpringJoint joint;
        joint.node = node;
        joint.stiffness = 0.1F;
        chain.joints.push_back(joint);
    }
    model.character.springs.push_back(chain);
    SpringBench bench(model);
    for (int i = 0; i < 20; ++i) {
        bench.move_root({0.03F * static_cast<float>(i), 1, 0});
        bench.step();
        const JointState& state = bench.state;
        for (const int node : {first, between, second, tip, ribbon}) {
            const auto joint = static_cast<std::size_t>(bench.tree.joint_of(node));
            EXPECT_LT(glm::distance(compute_world(bench.tree.joints, state, joint)[3],
                                    state.world[joint][3]),
                      1e-6F)
                << model.nodes[static_cast<std::size_t>(node)].name;
        }
        bench.expect_lengths_kept();
    }
}

TEST(SpringRig, chains_nearer_to_the_root_go_first_whatever_the_order_of_the_file) {
    Model model = rope(6);
    SpringChain upper = model.character.springs[0];
    SpringChain lower = upper;
    upper.joints.resize(4);
    lower.joints.erase(lower.joints.begin(), lower.joints.begin() + 3);
    model.character.springs = {lower, upper};
    SpringBench split(model);
    SpringBench whole(rope(6));
    ASSERT_EQ(split.rig.size(), whole.rig.size());
    for (int i = 0; i < 30; ++i) {
        for (SpringBench* bench : {&split, &whole}) {
            bench->move_root({0.02F * static_cast<float>(i), 1, 0});
            bench->step();
        }
        EXPECT_EQ(split.tip(), whole.tip());
    }
}

TEST(SpringRig, what_cannot_swing_is_left_out_and_said) {
    Model model = rope(3);
    model.nodes[3].translation = {0, 0, 0};  // the tail of the second joint
    model.character.springs.push_back(model.character.springs[0]);
    model.character.springs[1].name = "again";
    const int hidden = add_node(model, "hidden", -1, {});
    model.roots = {0};
    model.character.colliders.push_back({.node = hidden});
    model.character.springs[0].colliders = {0};
    SpringBench bench(model);
    EXPECT_EQ(bench.rig.size(), 1U);
    EXPECT_EQ(bench.warnings,
              (std::vector<std::string>{
                  "colliders left out, whose nodes are not in the scene: 1",
                  "node 2 of the spring \"chain\" does not swing: it has no length",
                  "node 1 of the spring \"again\" does not swing: it swings in another spring",
                  "node 2 of the spring \"again\" does not swing: it has no length",
              }));
}

TEST(SpringRig, stepping_is_real_time_safe) {
    SpringBench bench(rope(20));
    raks::test::RealtimeScope scope;
    for (int i = 0; i < 10; ++i) {
        bench.step();
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
