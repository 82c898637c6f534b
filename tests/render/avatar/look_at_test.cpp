#include "render/avatar/look_at.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/avatar/avatar_rig.hpp"
#include "tests/render/avatar/tiny_model.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models
using motion::Bone;

// A crooked humanoid with eyes, whose ranges are all different.
Model with_eyes() {
    Model model = crooked_humanoid_model();
    Character& character = model.character;
    const int head = character.humanoid.nodes[motion::index_of(Bone::head)];
    character.humanoid.left_eye = add_node(model, "eye.L", head, {0, 0, 0}, turn_about_x(0.4F));
    character.humanoid.right_eye = add_node(model, "eye.R", head, {0, 0, 0}, turn_about_z(0.4F));
    character.has_look_at = true;
    character.look_at.horizontal_inner = {.input_max = 90.0F, .output_scale = 9.0F};
    character.look_at.horizontal_outer = {.input_max = 45.0F, .output_scale = 18.0F};
    character.look_at.vertical_down = {.input_max = 90.0F, .output_scale = 27.0F};
    character.look_at.vertical_up = {.input_max = 90.0F, .output_scale = 45.0F};
    return model;
}

struct LookAtBench {
    Model model;
    AvatarRig rig;
    RigState state;

    explicit LookAtBench(Model made) : model(std::move(made)), rig(build_rig(model)), state(rig) {}
    // Rotation of a joint's node against its rest, in the avatar's axes.
    glm::quat turn_of(int node) {
        const auto joint = static_cast<std::size_t>(rig.tree.joint_of(node));
        const JointState rest = rest_state(rig.tree.joints);
        return rotation_of(state.joints.world[joint]) *
               glm::inverse(rotation_of(rest.world[joint]));
    }
    void apply(const Gaze& gaze) {
        rig.look_at.apply(gaze, state.joints, state.weights);
        update_world(rig.tree.joints, state.joints);
    }
};

TEST(LookAt, eyes_turn_by_their_ranges_inner_towards_the_nose) {
    LookAtBench bench(with_eyes());
    bench.apply({.yaw = 30.0F});
    EXPECT_TRUE(is_same_rotation(bench.turn_of(bench.model.character.humanoid.left_eye),
                                 turn_about_y(glm::radians(12.0F))));
    EXPECT_TRUE(is_same_rotation(bench.turn_of(bench.model.character.humanoid.right_eye),
                                 turn_about_y(glm::radians(3.0F))));
    bench.apply({.yaw = -80.0F});
    EXPECT_TRUE(is_same_rotation(bench.turn_of(bench.model.character.humanoid.left_eye),
                                 turn_about_y(glm::radians(-8.0F))));
    EXPECT_TRUE(is_same_rotation(bench.turn_of(bench.model.character.humanoid.right_eye),
                                 turn_about_y(glm::radians(-18.0F))));
}

TEST(LookAt, up_and_down_have_ranges_of_their_own) {
    LookAtBench bench(with_eyes());
    bench.apply({.pitch = 20.0F});
    const int eye = bench.model.character.humanoid.left_eye;
    const glm::vec3 up = bench.turn_of(eye) * glm::vec3(0, 0, 1);
    EXPECT_NEAR(glm::degrees(std::asin(up.y)), 10.0F, 1e-2F);
    bench.apply({.pitch = -20.0F});
    const glm::vec3 down = bench.turn_of(eye) * glm::vec3(0, 0, 1);
    EXPECT_NEAR(glm::degrees(std::asin(down.y)), -6.0F, 1e-2F);
    bench.apply({});
    EXPECT_TRUE(is_same_rotation(bench.turn_of(eye), motion::kNoRotation));
}

TEST(LookAt, the_gaze_is_measured_against_the_head_as_it_is_posed) {
    LookAtBench bench(with_eyes());
    motion::Pose pose;
    pose.hips_position = bench.rig.humanoid.rest_hips();
    pose.rotation(Bone::head) = turn_about_y(glm::radians(20.0F));
    pose_joints(bench.rig, pose, 1.0F, bench.state);
    const auto head = static_cast<std::size_t>(bench.rig.humanoid.joint(Bone::head));
    const glm::vec3 place(bench.state.joints.world[head][3]);
    const Gaze ahead = bench.rig.look_at.gaze_to(
        place + glm::vec3(0, 0, 3), bench.rig.tree.joints, bench.state.joints);
    EXPECT_NEAR(ahead.yaw, -20.0F, 1e-3F);
    EXPECT_NEAR(ahead.pitch, 0.0F, 1e-3F);
    const Gaze above = bench.rig.look_at.gaze_to(
        place + glm::vec3(std::sin(glm::radians(20.0F)), 1, std::cos(glm::radians(20.0F))),
        bench.rig.tree.joints,
        bench.state.joints);
    EXPECT_NEAR(above.yaw, 0.0F, 1e-3F);
    EXPECT_NEAR(above.pitch, 45.0F, 1e-3F);
}

TEST(LookAt, expressions_stand_in_for_eyes) {
    Model model = with_eyes();
    model.character.look_at.is_by_bones = false;
    model.character.look_at.horizontal_outer = {.input_max = 60.0F, .output_scale = 1.0F};
    model.character.look_at.vertical_down = {.input_max = 30.0F, .output_scale = 0.5F};
    for (const char* name : {"lookUp", "lookDown", "lookLeft", "lookRight"}) {
        Expression expression;
        expression.name = name;
        expression.is_preset = true;
        model.character.expressions.push_back(expression);
    }
    LookAtBench bench(model);
    bench.apply({.yaw = 15.0F, .pitch = -15.0F});
    EXPECT_EQ(bench.state.weights, (std::vector<float>{0.0F, 0.25F, 0.25F, 0.0F}));
    EXPECT_TRUE(
        is_same_rotation(bench.turn_of(model.character.humanoid.left_eye), motion::kNoRotation));
}

TEST(LookAt, a_model_without_look_at_keeps_its_eyes_still) {
    Model model = with_eyes();
    model.character.has_look_at = false;
    LookAtBench bench(model);
    EXPECT_FALSE(bench.rig.look_at.can_look());
    bench.apply({.yaw = 15.0F, .pitch = -15.0F});
    EXPECT_TRUE(
        is_same_rotation(bench.turn_of(model.character.humanoid.left_eye), motion::kNoRotation));
}

}  // namespace
}  // namespace raks::render
