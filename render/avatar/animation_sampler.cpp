#include "render/avatar/animation_sampler.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// Numbers of a value; of weights the first four are enough here.
std::size_t width_of(const AnimationChannel& channel) noexcept {
    switch (channel.path) {
        case ChannelPath::rotation:
            return 4;
        case ChannelPath::translation:
        case ChannelPath::scale:
            return 3;
        case ChannelPath::weights:
            break;
    }
    const std::size_t parts = channel.interpolation == Interpolation::cubic ? 3 : 1;
    return channel.values.size() / (channel.times.size() * parts);
}

// `part`: of cubic keys 0 the tangent before, 1 the value, 2 the tangent after.
glm::vec4 key_value(const AnimationChannel& channel, std::size_t key, std::size_t part) noexcept {
    const std::size_t width = width_of(channel);
    const bool is_cubic = channel.interpolation == Interpolation::cubic;
    const std::size_t first = (is_cubic ? 3 * key + part : key) * width;
    glm::vec4 value(0.0F);
    for (std::size_t i = 0; i < std::min<std::size_t>(width, 4); ++i) {
        value[static_cast<glm::length_t>(i)] = channel.values[first + i];
    }
    return value;
}

glm::vec4 slerped(const glm::vec4& a, const glm::vec4& b, float t) noexcept {
    const glm::quat q = glm::slerp(glm::quat(a.w, a.x, a.y, a.z), glm::quat(b.w, b.x, b.y, b.z), t);
    return {q.x, q.y, q.z, q.w};
}

glm::vec4 between(const AnimationChannel& channel, std::size_t key, float t) noexcept {
    const glm::vec4 a = key_value(channel, key, 1);
    const glm::vec4 b = key_value(channel, key + 1, 1);
    switch (channel.interpolation) {
        case Interpolation::step:
            return a;
        case Interpolation::linear:
            return channel.path == ChannelPath::rotation ? slerped(a, b, t) : a + (b - a) * t;
        case Interpolation::cubic:
            break;
    }
    // glTF 2.0, appendix C: Hermite spline, tangents in units a second.
    const float span = channel.times[key + 1] - channel.times[key];
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * a +
           (t3 - 2.0F * t2 + t) * span * key_value(channel, key, 2) + (3.0F * t2 - 2.0F * t3) * b +
           (t3 - t2) * span * key_value(channel, key + 1, 0);
}

glm::vec4 raw_sample(const AnimationChannel& channel, float seconds) noexcept {
    const std::vector<float>& times = channel.times;
    const auto next = std::upper_bound(times.begin(), times.end(), seconds);
    if (next == times.begin()) {
        return key_value(channel, 0, 1);
    }
    if (next == times.end()) {
        return key_value(channel, times.size() - 1, 1);
    }
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    return between(channel, key, (seconds - times[key]) / (times[key + 1] - times[key]));
}

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

glm::vec4 sample_channel(const AnimationChannel& channel, float seconds) noexcept {
    if (channel.times.empty()) {
        return channel.path == ChannelPath::rotation ? glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)
                                                     : glm::vec4(0.0F);
    }
    const glm::vec4 value = raw_sample(channel, seconds);
    if (channel.path != ChannelPath::rotation) {
        return value;
    }
    const float length = glm::length(value);
    return length > 0.0F ? value / length : glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
}

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
