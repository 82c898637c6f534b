#include "apps/xbody/skeleton_view.hpp"

#include <algorithm>
#include <iterator>

#include "apps/xbody/sight.hpp"
#include "base/printable.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/panes/name_tags.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

/// Names of bones by node; empty texts: no bone.
std::vector<std::string_view> bone_names(const render::Model& model,
                                         const render::HumanoidMap& humanoid) {
    std::vector<std::string_view> names(model.nodes.size());
    for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
        if (humanoid.nodes[bone] >= 0) {
            names[static_cast<std::size_t>(humanoid.nodes[bone])] = motion::kBoneNames[bone];
        }
    }
    return names;
}

/// Of each node whether it is a bone that a figure needs.
std::vector<bool> needed_nodes(const render::Model& model, const render::HumanoidMap& humanoid) {
    std::vector<bool> is_needed(model.nodes.size(), false);
    const auto add = [&](motion::Bone bone) {
        const int node = humanoid.nodes[motion::index_of(bone)];
        if (node >= 0) {
            is_needed[static_cast<std::size_t>(node)] = true;
        }
    };
    std::for_each(render::kRequiredBones.begin(), render::kRequiredBones.end(), add);
    return is_needed;
}

// A bone is a narrow kite, broad near the joint from which it comes.
void draw_bone(const render::PaneFrame& frame, const SeenNode& node) {
    constexpr float kBroadAt = 0.15F;  // of its length
    constexpr float kMostBroad = 5.0F;
    const glm::vec2 from = *node.from;
    const glm::vec2 along = node.at - from;
    const float length = glm::length(along);
    if (!(length > 1.0F)) {
        return;
    }
    const glm::vec2 across =
        glm::vec2(-along.y, along.x) / length * std::clamp(0.08F * length, 1.0F, kMostBroad);
    const glm::vec2 broad = from + kBroadAt * along;
    const auto corner = [](const glm::vec2& place) { return ImVec2(place.x, place.y); };
    const render::Colour colour = colour_of(node.kind).faded(0.75F);
    frame.pen.triangle(corner(from), corner(broad + across), corner(broad - across), colour);
    frame.pen.triangle(corner(broad + across), corner(node.at), corner(broad - across), colour);
}

}  // namespace

render::Colour colour_of(NodeKind kind) noexcept {
    switch (kind) {
        case NodeKind::bone:
            return render::palette::kAmber;
        case NodeKind::spring:
            return {0xA878FF};
        case NodeKind::mesh:
            return {0x5A8CFF};
        case NodeKind::part:
            return {0x3FD15A};
        case NodeKind::collider:
            return {0xF056B8};
        case NodeKind::helper:
            break;
    }
    return render::palette::kTeal;
}

std::vector<SeenNode> seen_skeleton(const ShownModel& model,
                                    const ShownPose& shown,
                                    const render::HumanoidMap& humanoid,
                                    const std::vector<bool>& is_hidden,
                                    const render::Camera& camera,
                                    const render::Box& box) {
    const render::Model& standing = model.figure.model;
    const Sight sight(camera, box);
    const std::vector<NodeKind> kinds = node_kinds(standing, humanoid);
    const std::vector<std::string_view> names = bone_names(standing, humanoid);
    const std::vector<bool> is_needed = needed_nodes(standing, humanoid);
    const render::JointTree& tree = model.avatar->rig->tree;
    const auto place_of = [&](int node) {
        const int joint = tree.joint_of(node);
        return joint < 0 ? std::nullopt
                         : sight.place_of(glm::vec3(
                               shown.state.joints.world[static_cast<std::size_t>(joint)][3]));
    };
    std::vector<SeenNode> seen;
    for (const SkeletonNode& one : skeleton_nodes(standing, humanoid)) {
        const auto index = static_cast<std::size_t>(one.node);
        const auto at = place_of(one.node);
        if (at && (is_hidden.empty() || !is_hidden[index])) {
            seen.push_back({one.node,
                            one.parent,
                            *at,
                            place_of(one.parent),
                            kinds[index],
                            names[index].empty() ? printable(standing.nodes[index].name, 40)
                                                 : std::string(names[index]),
                            is_needed[index]});
        }
    }
    return seen;
}

std::vector<bool> named_nodes(const std::vector<SeenNode>& nodes, const SkeletonLook& look) {
    const auto chosen = std::find_if(
        nodes.begin(), nodes.end(), [&](const SeenNode& node) { return node.node == look.chosen; });
    const bool has_needed = std::any_of(
        nodes.begin(), nodes.end(), [](const SeenNode& node) { return node.is_needed; });
    const auto is_named = [&](const SeenNode& node) {
        if (node.node == look.chosen || node.node == look.pointed) {
            return true;
        }
        if (!look.has_names) {
            return false;
        }
        return chosen == nodes.end() ? node.is_needed || !has_needed
                                     : node.parent == look.chosen || node.node == chosen->parent;
    };
    std::vector<bool> named;
    std::transform(nodes.begin(), nodes.end(), std::back_inserter(named), is_named);
    return named;
}

const SeenNode* node_near(const std::vector<SeenNode>& nodes, const glm::vec2& place) {
    constexpr float kNear = 8.0F;
    const auto distance = [&](const SeenNode& node) { return glm::distance(node.at, place); };
    const auto nearest =
        std::min_element(nodes.begin(), nodes.end(), [&](const auto& one, const auto& other) {
            return distance(one) < distance(other);
        });
    return nearest != nodes.end() && distance(*nearest) < kNear ? &*nearest : nullptr;
}

void draw_skeleton(const render::PaneFrame& frame,
                   const std::vector<SeenNode>& nodes,
                   const SkeletonLook& look) {
    constexpr float kDot = 2.5F;
    constexpr float kChosenDot = 6.0F;
    std::vector<render::NameTag> tags;
    for (const SeenNode& node : nodes) {
        if (node.from) {
            draw_bone(frame, node);
        }
    }
    const std::vector<bool> is_named = named_nodes(nodes, look);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const SeenNode& node = nodes[i];
        const bool is_chosen = node.node == look.chosen;
        frame.pen.dot(node.at.x, node.at.y, kDot, colour_of(node.kind));
        if (is_chosen) {
            frame.pen.ring(node.at.x, node.at.y, kChosenDot, render::palette::kText);
        }
        if (is_named[i]) {
            tags.push_back({node.at, node.name, render::palette::kText});
        }
    }
    draw_tags(frame, tags);
}

}  // namespace raks::apps
