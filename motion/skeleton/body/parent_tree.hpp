// Parent tree: questions about a tree that is given as the parent of each node.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raks::motion {

/// A forest of nodes as numbers, for many questions about one skeleton. Nodes may come in any
/// order; nodes on a loop of parents (which no reader lets pass) have depth 0 and nothing below.
class ParentTree {
 public:
    /// `parents`: by node, below 0 for a root. Cost: linear.
    explicit ParentTree(std::span<const int> parents);

    /// Whether `node` lies below `ancestor`, at any depth; a node is not below itself.
    [[nodiscard]] bool is_below(int node, int ancestor) const {
        const auto at = static_cast<std::size_t>(node);
        const auto over = static_cast<std::size_t>(ancestor);
        return begin_[over] < begin_[at] && begin_[at] < begin_[over] + size_[over];
    }
    /// Nodes above.
    [[nodiscard]] int depth(int node) const { return depth_[static_cast<std::size_t>(node)]; }
    /// The node above; below 0: none.
    [[nodiscard]] int parent(int node) const { return parents_[static_cast<std::size_t>(node)]; }
    /// The nodes right below, in the order of their numbers.
    [[nodiscard]] const std::vector<int>& children(int node) const {
        return children_[static_cast<std::size_t>(node)];
    }
    /// Number of nodes.
    [[nodiscard]] std::size_t size() const noexcept { return parents_.size(); }
    /// The nodes without a parent.
    [[nodiscard]] const std::vector<int>& roots() const noexcept { return roots_; }
    /// All nodes, every parent before its children.
    [[nodiscard]] const std::vector<int>& order() const noexcept { return order_; }

    /// The lowest node that is `a`, `b` or above both; below 0: none is.
    [[nodiscard]] int carrier_of(int a, int b) const;

 private:
    std::vector<int> parents_;
    std::vector<std::vector<int>> children_;
    std::vector<int> roots_;
    std::vector<int> order_;
    std::vector<int> begin_;  // by node: its number in the order of a walk into the depth
    std::vector<int> size_;   // by node: nodes at and below it
    std::vector<int> depth_;
};

}  // namespace raks::motion
