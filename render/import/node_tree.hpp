// Questions about the tree of a model's nodes.
#pragma once

#include <cstddef>
#include <vector>

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
class TreeOrder {
 public:
    explicit TreeOrder(const Model& model);

    /// The same as is_below above, at once.
    [[nodiscard]] bool is_below(int node, int ancestor) const {
        const auto at = static_cast<std::size_t>(node);
        const auto over = static_cast<std::size_t>(ancestor);
        return begin_[over] < begin_[at] && begin_[at] < begin_[over] + size_[over];
    }
    /// Nodes above.
    [[nodiscard]] int depth(int node) const { return depth_[static_cast<std::size_t>(node)]; }

 private:
    std::vector<int> begin_;  // by node: its number in the order of a walk into the depth
    std::vector<int> size_;   // by node: nodes at and below it
    std::vector<int> depth_;
};

}  // namespace raks::render
