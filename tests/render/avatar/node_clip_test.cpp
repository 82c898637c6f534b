#include "render/avatar/node_clip.hpp"

#include <gtest/gtest.h>

#include "render/avatar/avatar_rig.hpp"
#include "render/model/finite.hpp"
#include "tests/render/avatar/tiny_model.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models
using motion::Bone;

// Every bone turned by an amount of its own.
motion::Pose twisted_pose() {
    motion::Pose pose;
    for (std::size_t bone = 0; bone < pose.local_rotations.size(); ++bone) {
        const auto angle = 0.05F * static_cast<float>(bone % 7);
        pose.local_rotations[bone] = turn_about_z(angle) * turn_about_y(-angle);
    }
    pose.hips_position = {0.2F, 0.8F, -0.1F};
    return pose;
}

BoneRest rest_of(const Model& model) {
    const JointTree tree = build_joint_tree(model);
    const JointState rest = rest_state(tree.joints);
    BoneRest bones;
    for (const ModelNode& node : model.nodes) {
        bones.parents.push_back(node.parent);
    }
    for (std::size_t bone = 0; bone < bones.world.size(); ++bone) {
        const int joint = tree.joint_of(model.character.humanoid.nodes[bone]);
        const int above = joint < 0 ? -1 : tree.joints[static_cast<std::size_t>(joint)].parent;
        bones.world[bone] = joint < 0 ? motion::kNoRotation
                                      : rotation_of(rest.world[static_cast<std::size_t>(joint)]);
        bones.above[bone] = above < 0 ? motion::kNoRotation
                                      : rotation_of(rest.world[static_cast<std::size_t>(above)]);
    }
    return bones;
}

// A clip of one key that holds the model as `state` does.
void add_clip(const AvatarRig& rig, const JointState& state, Model& model) {
    ModelAnimation& clip = model.animations.emplace_back();
    for (std::size_t joint = 0; joint < rig.tree.joints.size(); ++joint) {
        const glm::quat& q = state.rotations[joint];
        const glm::vec3& p = state.translations[joint];
        const glm::vec3& s = state.scales[joint];
        clip.channels.push_back({.node = rig.tree.nodes[joint],
                                 .path = ChannelPath::rotation,
                                 .times = {1.0F},
                                 .values = {q.x, q.y, q.z, q.w}});
        clip.channels.push_back({.node = rig.tree.nodes[joint],
                                 .path = ChannelPath::translation,
                                 .times = {1.0F},
                                 .values = {p.x, p.y, p.z}});
        clip.channels.push_back({.node = rig.tree.nodes[joint],
                                 .path = ChannelPath::scale,
                                 .times = {1.0F},
                                 .values = {s.x, s.y, s.z}});
    }
}

void expect_same_places(const AvatarRig& rig, const JointState& is, const JointState& meant) {
    for (std::size_t joint = 0; joint < rig.tree.joints.size(); ++joint) {
        EXPECT_LT(glm::distance(is.world[joint][3], meant.world[joint][3]), 1e-4F)
            << rig.tree.joints[joint].name;
        EXPECT_TRUE(
            is_same_rotation(rotation_of(is.world[joint]), rotation_of(meant.world[joint]), 2e-3F))
            << rig.tree.joints[joint].name;
        EXPECT_NEAR(scale_of(is.world[joint]), scale_of(meant.world[joint]), 1e-4F)
            << rig.tree.joints[joint].name;
    }
}

TEST(NodeClip, is_the_inverse_of_posing_a_crooked_body) {
    Model model = crooked_humanoid_model();
    const AvatarRig rig = build_rig(model);
    RigState state(rig);
    const motion::Pose pose = twisted_pose();
    pose_joints(rig, pose, 1.0F, state);
    add_clip(rig, state.joints, model);
    NodeClip clip(model, 0, rest_of(model));
    EXPECT_EQ(clip.duration(), 1.0F);
    const motion::Pose again = clip.pose_at(0.5F);
    for (std::size_t bone = 0; bone < pose.local_rotations.size(); ++bone) {
        EXPECT_TRUE(
            is_same_rotation(again.local_rotations[bone], pose.local_rotations[bone], 1e-3F))
            << motion::kBoneNames[bone];
    }
    EXPECT_LT(glm::distance(again.hips_position, pose.hips_position), 1e-5F);
}

TEST(NodeClip, a_node_between_two_bones_turns_the_lower_one) {
    Model model = humanoid_model();
    HumanoidMap& map = model.character.humanoid;
    const auto chest = motion::index_of(Bone::chest);
    const int between = map.nodes[chest];
    map.nodes[chest] = -1;
    const BoneRest rest = rest_of(model);
    const glm::quat turn = turn_about_y(0.4F);
    model.animations.emplace_back().channels.push_back(
        {.node = between,
         .path = ChannelPath::rotation,
         .times = {0.0F},
         .values = {turn.x, turn.y, turn.z, turn.w}});
    const motion::Pose pose = NodeClip(model, 0, rest).pose_at(0.0F);
    EXPECT_TRUE(is_same_rotation(pose.rotation(Bone::chest), motion::kNoRotation));
    EXPECT_TRUE(is_same_rotation(pose.rotation(Bone::upper_chest), turn));
}

TEST(NodeClip, others_that_are_moved_show_the_clip_as_it_is) {
    Model model = crooked_humanoid_model();
    HumanoidMap& map = model.character.humanoid;
    const int head = map.nodes[motion::index_of(Bone::head)];
    add_node(model, "tip", add_node(model, "hair", head, {0.0F, 0.2F, 0.0F}), {0.1F, 0.0F, 0.0F});
    // Between two bones, as what twists a forearm is.
    map.nodes[motion::index_of(Bone::chest)] = -1;
    map.nodes[motion::index_of(Bone::left_hand)] = -1;
    const AvatarRig rig = build_rig(model);
    RigState meant(rig);
    for (std::size_t joint = 1; joint < rig.tree.joints.size(); ++joint) {
        const float angle = 0.1F * static_cast<float>(1 + joint % 5);
        meant.joints.rotations[joint] =
            meant.joints.rotations[joint] * turn_about_x(angle) * turn_about_y(-angle);
        meant.joints.translations[joint] += glm::vec3(0.02F * angle, -0.01F, 0.03F * angle);
        meant.joints.scales[joint] *= 1.0F + 0.1F * angle;
    }
    update_world(rig.tree.joints, meant.joints);
    add_clip(rig, meant.joints, model);
    NodeClip clip(model, 0, rest_of(model), OtherNodes::moved);
    RigState state(rig);
    const motion::Pose pose = clip.pose_at(1.0F);
    clip.move_others(1.0F, pose.hips_position, rig.tree, state.joints);
    pose_joints(rig, pose, 1.0F, state);
    expect_same_places(rig, state.joints, meant.joints);
}

// As feet of a rig for inverse kinematics, which hang below the legs in the body that dances.
TEST(NodeClip, a_foot_that_hangs_elsewhere_is_where_the_clip_has_it) {
    const Model body = humanoid_model();
    const HumanoidMap& map = body.character.humanoid;
    const int foot = map.nodes[motion::index_of(Bone::left_foot)];
    const int leg = map.nodes[motion::index_of(Bone::left_upper_leg)];
    Model file = body;
    ModelNode& moved = file.nodes[static_cast<std::size_t>(foot)];
    std::erase(file.nodes[static_cast<std::size_t>(moved.parent)].children, foot);
    moved.parent = map.nodes[0];
    file.nodes[static_cast<std::size_t>(moved.parent)].children.push_back(foot);
    const JointTree tree = build_joint_tree(file);
    JointState meant = rest_state(tree.joints);
    const auto foot_of_file = static_cast<std::size_t>(tree.joint_of(foot));
    meant.translations[foot_of_file] = {0.1F, -0.7F, 0.2F};
    meant.rotations[foot_of_file] = turn_about_x(0.5F);
    meant.rotations[static_cast<std::size_t>(tree.joint_of(leg))] = turn_about_x(-0.8F);
    update_world(tree.joints, meant);
    AvatarRig rig_of_file;
    rig_of_file.tree = tree;
    add_clip(rig_of_file, meant, file);

    const AvatarRig rig = build_rig(body);
    NodeClip clip(file, 0, rest_of(body), OtherNodes::moved);
    RigState state(rig);
    const motion::Pose pose = clip.pose_at(1.0F);
    clip.move_others(1.0F, pose.hips_position, rig.tree, state.joints);
    pose_joints(rig, pose, 1.0F, state);
    for (const int node : {foot, leg}) {
        const glm::mat4& is = state.joints.world[static_cast<std::size_t>(rig.tree.joint_of(node))];
        const glm::mat4& should_be = meant.world[static_cast<std::size_t>(tree.joint_of(node))];
        EXPECT_LT(glm::distance(is[3], should_be[3]), 1e-4F) << node;
        EXPECT_TRUE(is_same_rotation(rotation_of(is), rotation_of(should_be), 2e-3F));
    }
}

TEST(NodeClip, a_clip_without_size_moves_nothing_out_of_the_world) {
    Model model = humanoid_model();
    const BoneRest rest = rest_of(model);
    model.animations.emplace_back().channels.push_back(
        {.node = model.character.humanoid.nodes[motion::index_of(Bone::chest)],
         .path = ChannelPath::scale,
         .times = {0.0F},
         .values = {0.0F, 0.0F, 0.0F}});
    const AvatarRig rig = build_rig(model);
    NodeClip clip(model, 0, rest, OtherNodes::moved);
    RigState state(rig);
    const motion::Pose pose = clip.pose_at(0.0F);
    clip.move_others(0.0F, pose.hips_position, rig.tree, state.joints);
    pose_joints(rig, pose, 1.0F, state);
    for (const glm::mat4& world : state.joints.world) {
        EXPECT_TRUE(is_finite(world));
    }
}

TEST(NodeClip, a_model_that_faces_elsewhere_is_turned_to_the_front) {
    Model model = humanoid_model();
    BoneRest rest = rest_of(model);
    rest.turn = turn_about_y(1.0F);
    for (glm::quat& world : rest.world) {
        world = rest.turn * world;
    }
    model.animations.emplace_back().channels.push_back({.node = 0,
                                                        .path = ChannelPath::translation,
                                                        .times = {0.0F},
                                                        .values = {1.0F, 1.0F, 0.0F}});
    const motion::Pose pose = NodeClip(model, 0, rest).pose_at(0.0F);
    EXPECT_TRUE(is_same_rotation(pose.rotation(Bone::hips), motion::kNoRotation));
    EXPECT_LT(glm::distance(pose.hips_position, rest.turn * glm::vec3(1.0F, 1.0F, 0.0F)), 1e-5F);
}

}  // namespace
}  // namespace raks::render
