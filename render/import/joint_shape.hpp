// Joint shape: the tree of a model's joints with their flesh, and the limbs in it.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// The flesh of a model's nodes: the vertices that each of them moves most.
struct NodeFlesh {
    std::vector<std::size_t> vertices;  ///< by node: how many
    std::vector<glm::vec3> tips;        ///< by node: the vertex that is farthest from it; its place
                                        ///< where it has none
    /// Whether a node or one below it moves any; true of all where the model shows nothing.
    std::vector<bool> is_fleshy;

    [[nodiscard]] bool is_empty() const noexcept { return vertices.empty(); }
};

/// The flesh of all nodes, with the nodes at `world`. Threads: any. Real-time: no.
[[nodiscard]] NodeFlesh flesh_of(const Model& model, std::span<const glm::mat4> world);

/// Two limbs of a figure, left at +x.
struct LimbPair {
    std::vector<int> left;
    std::vector<int> right;
};

/// The tree of those nodes that count, with what is asked of it. Lengths are in the file's unit. A
/// joint without joints below it reaches as far as its flesh. `places`: of all nodes, y up.
class JointShape {
 public:
    /// `flesh`: empty: nothing is known of it. What it is made of must outlive it.
    JointShape(const Model& model,
               std::span<const glm::vec3> places,
               const NodeFlesh& flesh,
               const std::vector<bool>& counts);

    [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<int>& children(int node) const {
        return children_[static_cast<std::size_t>(node)];
    }
    /// The next node above that counts; -1: none.
    [[nodiscard]] int parent(int node) const { return parents_[static_cast<std::size_t>(node)]; }
    [[nodiscard]] glm::vec3 place(int node) const {
        return places_[static_cast<std::size_t>(node)];
    }
    /// Where a limb that ends at this node ends: where its flesh does.
    [[nodiscard]] glm::vec3 tip(int node) const;
    [[nodiscard]] float lowest() const { return lowest_; }
    [[nodiscard]] float height() const { return highest_ - lowest_; }

    /// The longest way from a node to a leaf, the node first.
    [[nodiscard]] std::vector<int> longest_way(int node) const;
    /// Length of the longest way from a node to a leaf's tip.
    [[nodiscard]] float reach(int node) const { return reach_[static_cast<std::size_t>(node)]; }
    /// Highest place at and below a node.
    [[nodiscard]] float top(int node) const { return tops_[static_cast<std::size_t>(node)]; }
    /// Highest place at and above a node, all that hangs on what is above but not on it.
    [[nodiscard]] float top_above(int node) const;

    /// The two limbs that begin at children of `node` but `other`, are alike, have at least
    /// `joints` joints, and of which `is_fit` approves. Empty: there are none.
    [[nodiscard]] LimbPair alike_limbs(
        int node,
        int other,
        std::size_t joints,
        const std::function<bool(const std::vector<int>&)>& is_fit) const;

 private:
    [[nodiscard]] float length_to(int from, int child) const;
    void measure();

    std::span<const glm::vec3> places_;
    const NodeFlesh& flesh_;
    std::vector<int> nodes_;
    std::vector<int> roots_;
    std::vector<int> parents_;                // by node
    std::vector<std::vector<int>> children_;  // by node
    std::vector<float> reach_;                // by node
    std::vector<float> tops_;                 // by node
    float lowest_ = 0.0F;
    float highest_ = 0.0F;
};

}  // namespace raks::render
