#include "apps/xbody/skeleton_view.hpp"

#include <algorithm>

#include "apps/xbody/sight.hpp"
#include "base/printable.hpp"
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
                            *at,
                            place_of(one.parent),
                            kinds[index],
                            names[index].empty() ? printable(standing.nodes[index].name, 40)
                                                 : std::string(names[index])});
        }
    }
    return seen;
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
    for (const SeenNode& node : nodes) {
        const bool is_chosen = node.node == look.chosen;
        frame.pen.dot(node.at.x, node.at.y, kDot, colour_of(node.kind));
        if (is_chosen) {
            frame.pen.ring(node.at.x, node.at.y, kChosenDot, render::palette::kText);
        }
        if (is_chosen || look.has_names) {
            tags.push_back({node.at, node.name, render::palette::kText});
        }
    }
    draw_tags(frame, tags);
}

}  // namespace raks::apps
