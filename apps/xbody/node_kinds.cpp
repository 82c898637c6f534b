#include "apps/xbody/node_kinds.hpp"

#include <array>
#include <cstddef>

namespace raks::apps {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Later marks win.
void mark(std::vector<NodeKind>& kinds, int node, NodeKind kind) {
    if (node >= 0) {
        kinds[at(node)] = kind;
    }
}

}  // namespace

std::string_view words_of(NodeKind kind) noexcept {
    constexpr std::array<std::string_view, 6> kWords = {
        "bone", "spring", "mesh", "rigid part", "collider", "helper"};
    return kWords[static_cast<std::size_t>(kind)];
}

std::vector<NodeKind> node_kinds(const render::Model& model, const render::HumanoidMap& humanoid) {
    std::vector<NodeKind> kinds(model.nodes.size(), NodeKind::helper);
    for (const render::SpringCollider& collider : model.character.colliders) {
        mark(kinds, collider.node, NodeKind::collider);
    }
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].mesh >= 0) {
            kinds[i] = model.nodes[i].skin >= 0 ? NodeKind::mesh : NodeKind::part;
        }
    }
    for (const render::SpringChain& chain : model.character.springs) {
        for (const render::SpringJoint& joint : chain.joints) {
            mark(kinds, joint.node, NodeKind::spring);
        }
    }
    for (const int node : humanoid.nodes) {
        mark(kinds, node, NodeKind::bone);
    }
    for (const int node : {humanoid.left_eye, humanoid.right_eye, humanoid.jaw}) {
        mark(kinds, node, NodeKind::bone);
    }
    return kinds;
}

std::vector<SkeletonNode> skeleton_nodes(const render::Model& model,
                                         const render::HumanoidMap& humanoid) {
    std::vector<bool> is_drawn(model.nodes.size(), false);
    for (const int node : humanoid.nodes) {
        if (node >= 0) {
            is_drawn[at(node)] = true;
        }
    }
    for (const render::ModelSkin& skin : model.skins) {
        for (const int joint : skin.joints) {
            is_drawn[at(joint)] = true;
        }
    }
    for (std::size_t i = 0; model.skins.empty() && i < model.nodes.size(); ++i) {
        is_drawn[i] = is_drawn[i] || model.nodes[i].mesh >= 0;
    }
    std::vector<SkeletonNode> drawn;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (is_drawn[i]) {
            int above = model.nodes[i].parent;
            while (above >= 0 && !is_drawn[at(above)]) {
                above = model.nodes[at(above)].parent;
            }
            drawn.push_back({static_cast<int>(i), above});
        }
    }
    return drawn;
}

}  // namespace raks::apps
