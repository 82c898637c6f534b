#include "render/avatar/node_clip.hpp"

#include <algorithm>

#include "render/model/finite.hpp"

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
      others_(others),
      order_(parents_first(model)),
      moved_(model.nodes.size()),
      carries_hips_(model.nodes.size(), false),
      world_(model.nodes.size()) {
    for (const AnimationChannel& channel : model.animations[animation].channels) {
        if (channel.times.empty() || channel.node < 0) {
            continue;
        }
        duration_ = std::max(duration_, channel.times.back());
        moved_[static_cast<std::size_t>(channel.node)].take(channel);
    }
    if (others_ == OtherNodes::moved) {
        for (int node = model.character.humanoid.nodes[0]; node >= 0;) {
            node = rest_.parents[static_cast<std::size_t>(node)];
            if (node >= 0) {
                carries_hips_[static_cast<std::size_t>(node)] = true;
            }
        }
    }
}

void NodeClip::move_others(float seconds,
                           const glm::vec3& hips,
                           const JointTree& tree,
                           JointState& state) {
    if (others_ == OtherNodes::folded || tree.joint_of_node.size() < model_.nodes.size()) {
        return;  // or the file has changed since the tree was read
    }
    move_nodes(seconds);
    const auto hips_node = static_cast<std::size_t>(model_.character.humanoid.nodes[0]);
    const glm::mat4 rig_from_file =
        glm::translate(glm::mat4(1.0F), hips) * glm::mat4_cast(rest_.turn) *
        glm::scale(glm::mat4(1.0F), glm::vec3(tree.scale)) *
        glm::translate(glm::mat4(1.0F), -glm::vec3(world_[hips_node][3]));
    for (std::size_t joint = 0; joint < tree.joints.size(); ++joint) {
        const auto node = static_cast<std::size_t>(tree.nodes[joint]);
        if (carries_hips_[node]) {
            continue;
        }
        const int parent = tree.joints[joint].parent;
        glm::mat4 local = rig_from_file * world_[node];
        if (parent >= 0) {
            const auto above = static_cast<std::size_t>(parent);
            const auto node_above = static_cast<std::size_t>(tree.nodes[above]);
            // What carries the hips rests in the rig, wherever the clip has it.
            local = carries_hips_[node_above]
                        ? glm::inverse(compute_world(tree.joints, state, above)) * local
                        : glm::inverse(world_[node_above]) * world_[node];
        }
        // Below what has no size, nothing is seen.
        if (is_finite(local)) {
            const NodePlace place = place_of(local);
            state.translations[joint] = place.translation;
            state.rotations[joint] = place.rotation;
            state.scales[joint] = place.scale;
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

// Against what the bone hangs on in the rig, whatever turns between it and the next bone above.
glm::quat NodeClip::turn_in_rig(std::size_t bone) const {
    const auto node = static_cast<std::size_t>(model_.character.humanoid.nodes[bone]);
    const int above = rest_.parents[node];
    glm::mat4 local = world_[node];
    if (above >= 0) {
        local = glm::inverse(world_[static_cast<std::size_t>(above)]) * local;
    }
    if (!is_finite(local)) {
        return motion::kNoRotation;
    }
    return glm::normalize(rest_.above[bone] * place_of(local).rotation *
                          glm::inverse(rest_.world[bone]));
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
            pose.local_rotations[bone] = bone > 0 && others_ == OtherNodes::moved
                                             ? turn_in_rig(bone)
                                             : glm::normalize(glm::inverse(above) * turned[bone]);
        }
    }
    if (nodes[0] >= 0) {
        pose.hips_position = rest_.turn * glm::vec3(world_[static_cast<std::size_t>(nodes[0])][3]);
    }
    return pose;
}

}  // namespace raks::render
