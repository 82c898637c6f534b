#include "render/import/body_parents.hpp"

#include <fmt/format.h>

#include "render/import/node_tree.hpp"

namespace raks::render {
namespace {

/// Whether `node` is `ancestor` or lies below it, by these parents.
bool hangs_on(const std::vector<int>& parents, int node, int ancestor) {
    for (int up = node; up >= 0; up = parents[static_cast<std::size_t>(up)]) {
        if (up == ancestor) {
            return true;
        }
    }
    return false;
}

/// Turns the way from `top` down to `low` over: `low` hangs where `top` did, and carries it.
void turn_over(std::vector<int>& parents, int top, int low) {
    int below = parents[static_cast<std::size_t>(top)];
    for (int node = low; below != top;) {
        const int above = parents[static_cast<std::size_t>(node)];
        parents[static_cast<std::size_t>(node)] = below;
        below = node;
        node = above;
    }
}

}  // namespace

BodyParents body_parents(const Model& model) {
    BodyParents body;
    for (const ModelNode& node : model.nodes) {
        body.parents.push_back(node.parent);
    }
    std::vector<int>& parents = body.parents;
    const HumanoidMap& humanoid = model.character.humanoid;
    for (int bone = 0; bone < motion::kBoneCount; ++bone) {
        const int parent_bone = mapped_parent(humanoid, bone);
        int node = humanoid.nodes[static_cast<std::size_t>(bone)];
        if (node < 0 || parent_bone < 0) {
            continue;
        }
        const int parent = humanoid.nodes[static_cast<std::size_t>(parent_bone)];
        const auto note = [&](const char* what) {
            body.notes.push_back(
                fmt::format("\"{}\" ({}) does not lie below the {}; {}",
                            node_of(model, node).name,
                            motion::kBoneNames[static_cast<std::size_t>(bone)],
                            motion::kBoneNames[static_cast<std::size_t>(parent_bone)],
                            what));
        };
        if (hangs_on(parents, node, parent)) {
            continue;
        }
        if (hangs_on(parents, parent, node)) {
            if (parent_bone == 0) {
                note("the tree is turned over there");
                turn_over(parents, node, parent);
            }
            continue;
        }
        note("it is moved there");
        // As far up as it carries nothing that carries the parent, too.
        while (parents[static_cast<std::size_t>(node)] >= 0 &&
               !hangs_on(parents, parent, parents[static_cast<std::size_t>(node)])) {
            node = parents[static_cast<std::size_t>(node)];
        }
        parents[static_cast<std::size_t>(node)] = parent;
    }
    return body;
}

std::vector<std::size_t> parents_first(const std::vector<int>& parents) {
    std::vector<std::vector<std::size_t>> children(parents.size());
    std::vector<std::size_t> order;
    order.reserve(parents.size());
    for (std::size_t node = 0; node < parents.size(); ++node) {
        if (parents[node] < 0) {
            order.push_back(node);
        } else {
            children[static_cast<std::size_t>(parents[node])].push_back(node);
        }
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
        const std::vector<std::size_t>& below = children[order[next]];
        order.insert(order.end(), below.begin(), below.end());
    }
    return order;
}

}  // namespace raks::render
