#include "render/avatar/animation_sampler.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models
using motion::Bone;

AnimationChannel channel_of(int node,
                            ChannelPath path,
                            Interpolation interpolation,
                            std::vector<float> times,
                            std::vector<float> values) {
    AnimationChannel channel;
    channel.node = node;
    channel.path = path;
    channel.interpolation = interpolation;
    channel.times = std::move(times);
    channel.values = std::move(values);
    return channel;
}

std::vector<float> numbers_of(const std::vector<glm::quat>& rotations) {
    std::vector<float> numbers;
    for (const glm::quat& q : rotations) {
        numbers.insert(numbers.end(), {q.x, q.y, q.z, q.w});
    }
    return numbers;
}

TEST(AnimationSampler, values_lie_between_their_keys_and_are_held_at_the_ends) {
    const auto x_at = [](Interpolation how, float seconds) {
        const std::vector<float> plain = {0, 0, 0, 2, 0, 0};
        const std::vector<float> cubic = {9, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 9, 0, 0};
        const AnimationChannel channel = channel_of(
            0, ChannelPath::translation, how, {1, 3}, how == Interpolation::cubic ? cubic : plain);
        return sample_channel(channel, seconds).x;
    };
    for (const Interpolation how :
         {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
        EXPECT_EQ(x_at(how, 0.0F), 0.0F);
        EXPECT_EQ(x_at(how, 3.0F), 2.0F);
        EXPECT_EQ(x_at(how, 9.0F), 2.0F);
    }
    EXPECT_EQ(x_at(Interpolation::step, 2.9F), 0.0F);
    EXPECT_FLOAT_EQ(x_at(Interpolation::linear, 1.5F), 0.5F);
    // Both tangents are the straight line's.
    EXPECT_FLOAT_EQ(x_at(Interpolation::cubic, 1.5F), 0.5F);
}

TEST(AnimationSampler, a_clip_of_a_crooked_body_is_the_pose_of_a_straight_one) {
    Model model = crooked_humanoid_model();
    const JointTree tree = build_joint_tree(model);
    const JointState rest = rest_state(tree.joints);
    const auto arm = motion::index_of(Bone::left_upper_arm);
    const auto joint = static_cast<std::size_t>(tree.joint_of(static_cast<int>(arm)));
    const glm::quat world = rotation_of(rest.world[joint]);
    const glm::quat above =
        rotation_of(rest.world[static_cast<std::size_t>(tree.joints[joint].parent)]);
    // The arm turned by half a radian about z, in the body's axes.
    const glm::quat turned = glm::inverse(above) * turn_about_z(0.5F) * world;
    ModelAnimation animation;
    animation.channels.push_back(channel_of(static_cast<int>(arm),
                                            ChannelPath::rotation,
                                            Interpolation::linear,
                                            {0, 1},
                                            numbers_of({model.nodes[arm].rotation, turned})));
    model.animations.push_back(animation);
    const AnimationSampler sampler(model, 0);
    EXPECT_EQ(sampler.duration(), 1.0F);
    EXPECT_FALSE(sampler.has_travel());
    const motion::Pose pose = sampler.pose_at(0.5F);
    EXPECT_TRUE(is_same_rotation(pose.rotation(Bone::left_upper_arm), turn_about_z(0.25F)));
    EXPECT_TRUE(is_same_rotation(pose.rotation(Bone::left_lower_arm), motion::kNoRotation));
    EXPECT_LT(glm::distance(pose.hips_position, glm::vec3(rest.world[0][3])), 1e-6F);
}

TEST(AnimationSampler, the_hips_travel_in_the_world) {
    Model model = humanoid_model();
    const int root = add_node(model, "root", -1, {0, 0, 1}, turn_about_y(1.5707963F));
    model.nodes[0].parent = root;
    model.nodes[static_cast<std::size_t>(root)].children = {0};
    model.roots = {root};
    ModelAnimation animation;
    animation.channels.push_back(
        channel_of(0, ChannelPath::translation, Interpolation::step, {0}, {0, 1, 2}));
    model.animations.push_back(animation);
    const AnimationSampler sampler(model, 0);
    EXPECT_TRUE(sampler.has_travel());
    EXPECT_LT(glm::distance(sampler.pose_at(0.0F).hips_position, glm::vec3(2, 1, 1)), 1e-6F);
}

TEST(AnimationSampler, nodes_that_stand_for_the_face_move_it) {
    Model model = humanoid_model();
    const int happy = add_node(model, "happy", -1, {});
    const int gaze = add_node(model, "gaze", -1, {});
    model.animated_face.expressions.emplace_back("happy", happy);
    model.animated_face.look_at = gaze;
    ModelAnimation animation;
    animation.channels.push_back(channel_of(
        happy, ChannelPath::translation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0}));
    animation.channels.push_back(
        channel_of(gaze, ChannelPath::translation, Interpolation::step, {0}, {1, 2, 3}));
    model.animations.push_back(animation);
    const Face face = AnimationSampler(model, 0).face_at(0.25F);
    EXPECT_FLOAT_EQ(face.weight(FaceExpression::happy), 0.25F);
    EXPECT_EQ(face.gaze_target, glm::vec3(1, 2, 3));
    EXPECT_EQ(face.gaze, 1.0F);
}

}  // namespace
}  // namespace raks::render
