// Questions about the tree of a model's nodes.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/skeleton/body/parent_tree.hpp"
#include "render/model/model.hpp"

namespace raks::render {

[[nodiscard]] inline const ModelNode& node_of(const Model& model, int node) {
    return model.nodes[static_cast<std::size_t>(node)];
}

/// Whether `node` lies below `ancestor`, at any depth; a node is not below itself. Walks up.
[[nodiscard]] inline bool is_below(const Model& model, int node, int ancestor) {
    for (int up = node_of(model, node).parent; up >= 0; up = node_of(model, up).parent) {
        if (up == ancestor) {
            return true;
        }
    }
    return false;
}

/// All nodes, every parent before its children.
[[nodiscard]] std::vector<int> parents_first(const Model& model);

/// The tree as numbers, for many questions about one model.
class TreeOrder : public motion::ParentTree {
 public:
    explicit TreeOrder(const Model& model);
};

}  // namespace raks::render
