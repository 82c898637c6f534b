#include "render/avatar/node_clip.hpp"

#include <algorithm>

#include "render/avatar/animation_sampler.hpp"
#include "render/avatar/joint_tree.hpp"

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

NodeClip::NodeClip(const Model& model, std::size_t animation, const BoneRest& rest)
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
            pose.local_rotations[bone] = glm::normalize(glm::inverse(above) * turned[bone]);
        }
    }
    if (nodes[0] >= 0) {
        pose.hips_position = rest_.turn * glm::vec3(world_[static_cast<std::size_t>(nodes[0])][3]);
    }
    return pose;
}

}  // namespace raks::render
