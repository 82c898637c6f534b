#include "render/avatar/animation_sampler.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// Rotation of what a bone's rotation counts from: its node's parent; in VRMA the next bone above.
glm::quat above_bone(const Model& model,
                     const JointTree& tree,
                     const JointState& rest,
                     motion::Bone bone,
                     std::size_t joint) {
    if (!model.animated_face.is_vrma || bone == motion::Bone::hips) {
        return rotation_of(rest.world[joint]) * glm::inverse(rest.rotations[joint]);
    }
    const auto& nodes = model.character.humanoid.nodes;
    auto above = motion::index_of(bone);
    do {
        above = motion::kBoneParents[above];
    } while (above != 0 && tree.joint_of(nodes[above]) < 0);
    const int parent = tree.joint_of(nodes[above]);
    return parent < 0 ? motion::kNoRotation
                      : rotation_of(rest.world[static_cast<std::size_t>(parent)]);
}

glm::quat rotation_at(const AnimationChannel& channel, float seconds) noexcept {
    const glm::vec4 q = sample_channel(channel, seconds);
    return {q.w, q.x, q.y, q.z};
}

}  // namespace

AnimationSampler::AnimationSampler(const Model& model,
                                   std::size_t animation,
                                   const std::vector<glm::quat>& t_pose) {
    const JointTree tree = build_joint_tree(model);
    const JointState rest = t_pose_state(model, tree, t_pose);
    const auto& nodes = model.character.humanoid.nodes;
    const int hips = tree.joint_of(nodes[0]);
    if (hips >= 0) {
        const auto joint = static_cast<std::size_t>(hips);
        rest_hips_ = glm::vec3(rest.world[joint][3]);
        const int parent = tree.joints[joint].parent;
        if (parent >= 0) {
            world_from_hips_parent_ = rest.world[static_cast<std::size_t>(parent)];
        }
    }
    for (const AnimationChannel& channel : model.animations[animation].channels) {
        if (channel.times.empty()) {
            continue;
        }
        duration_ = std::max(duration_, channel.times.back());
        for (std::size_t b = 0; b < nodes.size(); ++b) {
            if (nodes[b] >= 0 && nodes[b] == channel.node) {
                add_bone(model, tree, rest, static_cast<motion::Bone>(b), channel);
            }
        }
        add_face(model, channel);
    }
}

void AnimationSampler::add_bone(const Model& model,
                                const JointTree& tree,
                                const JointState& rest,
                                motion::Bone bone,
                                const AnimationChannel& channel) {
    if (tree.joint_of(channel.node) < 0) {
        return;
    }
    const auto joint = static_cast<std::size_t>(tree.joint_of(channel.node));
    if (channel.path == ChannelPath::translation && bone == motion::Bone::hips) {
        hips_ = &channel;
        has_travel_ = true;
    }
    if (channel.path != ChannelPath::rotation) {
        return;
    }
    turned_.push_back({.channel = &channel,
                       .bone = bone,
                       .before = above_bone(model, tree, rest, bone, joint),
                       .after = glm::inverse(rotation_of(rest.world[joint]))});
}

void AnimationSampler::add_face(const Model& model, const AnimationChannel& channel) {
    if (channel.path != ChannelPath::translation) {
        return;
    }
    if (channel.node == model.animated_face.look_at) {
        gaze_ = &channel;
    }
    for (const auto& [name, node] : model.animated_face.expressions) {
        const auto* const found =
            std::find(kFaceExpressionNames.begin(), kFaceExpressionNames.end(), name);
        if (node == channel.node && found != kFaceExpressionNames.end()) {
            expressions_.emplace_back(
                static_cast<FaceExpression>(found - kFaceExpressionNames.begin()), &channel);
        }
    }
}

motion::Pose AnimationSampler::pose_at(float seconds) const noexcept {
    motion::Pose pose;
    for (const Turned& turned : turned_) {
        pose.rotation(turned.bone) =
            glm::normalize(turned.before * rotation_at(*turned.channel, seconds) * turned.after);
    }
    pose.hips_position = rest_hips_;
    if (hips_ != nullptr) {
        const glm::vec3 place(sample_channel(*hips_, seconds));
        pose.hips_position = glm::vec3(world_from_hips_parent_ * glm::vec4(place, 1.0F));
    }
    return pose;
}

Face AnimationSampler::face_at(float seconds) const noexcept {
    Face face;
    for (const auto& [expression, channel] : expressions_) {
        face.weight(expression) = std::clamp(sample_channel(*channel, seconds).x, 0.0F, 1.0F);
    }
    if (gaze_ != nullptr) {
        face.gaze_target = glm::vec3(sample_channel(*gaze_, seconds));
        face.gaze = 1.0F;
    }
    return face;
}

}  // namespace raks::render
