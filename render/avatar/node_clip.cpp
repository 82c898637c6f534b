#include "render/avatar/node_clip.hpp"

#include <algorithm>

#include "render/avatar/animation_sampler.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

std::vector<std::size_t> parents_first(const Model& model) {
    std::vector<std::size_t> order;
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        if (model.nodes[node].parent < 0) {
            order.push_back(node);
        }
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
        for (const int child : model.nodes[order[next]].children) {
            order.push_back(static_cast<std::size_t>(child));
        }
    }
    return order;
}

}  // namespace

NodeClip::NodeClip(const Model& model,
                   std::size_t animation,
                   const BoneRest& rest,
                   OtherNodes others)
    : model_(model),
      rest_(rest),
      order_(parents_first(model)),
      moved_(model.nodes.size()),
      world_(model.nodes.size()) {
    for (const AnimationChannel& channel : model.animations[animation].channels) {
        if (channel.times.empty() || channel.node < 0) {
            continue;
        }
        duration_ = std::max(duration_, channel.times.back());
        moved_[static_cast<std::size_t>(channel.node)].take(channel);
    }
    if (others == OtherNodes::moved) {
        find_others();
    }
}

void NodeClip::find_others() {
    const auto& bones = model_.character.humanoid.nodes;
    std::vector<bool> is_of_bones(model_.nodes.size());
    for (std::size_t bone = 0; bone < bones.size(); ++bone) {
        for (int node = bones[bone]; node >= 0 && !is_of_bones[static_cast<std::size_t>(node)];
             node = model_.nodes[static_cast<std::size_t>(node)].parent) {
            is_of_bones[static_cast<std::size_t>(node)] = true;
        }
    }
    for (const std::size_t node : order_) {
        // A root carries the turn and the size that the whole model is given.
        if (moved_[node].is_moved() && !is_of_bones[node] && model_.nodes[node].parent >= 0) {
            others_.push_back(static_cast<int>(node));
        }
    }
    for (std::size_t bone = 1; bone < bones.size(); ++bone) {
        if (bones[bone] >= 0) {
            take_between(static_cast<motion::Bone>(bone));
        }
    }
}

void NodeClip::take_between(motion::Bone bone) {
    const auto& bones = model_.character.humanoid.nodes;
    const int above =
        mapped_parent(model_.character.humanoid, static_cast<int>(motion::index_of(bone)));
    const int end = above < 0 ? -1 : bones[static_cast<std::size_t>(above)];
    std::vector<int> between;
    int node = model_.nodes[static_cast<std::size_t>(bones[motion::index_of(bone)])].parent;
    for (; node >= 0 && std::find(bones.begin(), bones.end(), node) == bones.end();
         node = model_.nodes[static_cast<std::size_t>(node)].parent) {
        if (moved_[static_cast<std::size_t>(node)].is_moved()) {
            between.push_back(node);
        }
    }
    // One that hangs elsewhere, as feet of inverse kinematics do, is posed in the world.
    if (node == end && node >= 0 && !between.empty()) {
        is_apart_[motion::index_of(bone)] = true;
        for (const int one : between) {
            if (std::find(others_.begin(), others_.end(), one) == others_.end()) {
                others_.push_back(one);
            }
        }
    }
}

void NodeClip::move_others(float seconds, const JointTree& tree, JointState& state) const noexcept {
    if (tree.joint_of_node.size() < model_.nodes.size()) {
        return;  // the file has changed since the tree was read
    }
    for (const int node : others_) {
        const int joint = tree.joint_of(node);
        if (joint >= 0) {
            const auto i = static_cast<std::size_t>(node);
            const NodePlace place = moved_[i].at(model_.nodes[i], seconds);
            state.translations[static_cast<std::size_t>(joint)] = place.translation;
            state.rotations[static_cast<std::size_t>(joint)] = place.rotation;
        }
    }
}

void NodeClip::move_nodes(float seconds) {
    for (const std::size_t i : order_) {
        const ModelNode& node = model_.nodes[i];
        const NodePlace place = moved_[i].at(node, seconds);
        const glm::mat4 local = glm::translate(glm::mat4(1.0F), place.translation) *
                                glm::mat4_cast(place.rotation) *
                                glm::scale(glm::mat4(1.0F), place.scale);
        world_[i] = node.parent < 0 ? local : world_[static_cast<std::size_t>(node.parent)] * local;
    }
}

glm::quat NodeClip::turn_below_parent(std::size_t bone, float seconds) const {
    const auto node = static_cast<std::size_t>(model_.character.humanoid.nodes[bone]);
    const glm::quat local = moved_[node].at(model_.nodes[node], seconds).rotation;
    return glm::normalize(rest_.above[bone] * local * glm::inverse(rest_.world[bone]));
}

motion::Pose NodeClip::pose_at(float seconds) {
    move_nodes(seconds);
    motion::Pose pose;
    const auto& nodes = model_.character.humanoid.nodes;
    // Since the T-pose, in the world; bones that the model lacks go with the next above.
    std::array<glm::quat, motion::kBoneCount> turned{};
    for (std::size_t bone = 0; bone < nodes.size(); ++bone) {
        const glm::quat& above =
            bone == 0 ? motion::kNoRotation : turned[motion::kBoneParents[bone]];
        turned[bone] = above;
        if (nodes[bone] >= 0) {
            const glm::quat now = rotation_of(world_[static_cast<std::size_t>(nodes[bone])]);
            turned[bone] = rest_.turn * now * glm::inverse(rest_.world[bone]);
            pose.local_rotations[bone] = is_apart_[bone]
                                             ? turn_below_parent(bone, seconds)
                                             : glm::normalize(glm::inverse(above) * turned[bone]);
        }
    }
    if (nodes[0] >= 0) {
        pose.hips_position = rest_.turn * glm::vec3(world_[static_cast<std::size_t>(nodes[0])][3]);
    }
    return pose;
}

}  // namespace raks::render
