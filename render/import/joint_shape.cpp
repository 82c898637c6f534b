#include "render/import/joint_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/import/bind_places.hpp"
#include "render/import/node_tree.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr float kAlike = 0.15F;  // two limbs differ by less of their length
// What it costs to look has a bound: no figure has more limbs at one joint.
constexpr std::size_t kMostBranches = 32;

}  // namespace

NodeFlesh flesh_of(const Model& model, std::span<const glm::mat4> world) {
    NodeFlesh flesh;
    flesh.vertices.assign(model.nodes.size(), 0);
    flesh.tips = places_of(world);
    std::vector<float> farthest(model.nodes.size(), 0.0F);
    for_each_vertex(model, world, [&](int node, const glm::vec3& place) {
        const auto at = static_cast<std::size_t>(node);
        ++flesh.vertices[at];
        const float away = glm::distance(place, glm::vec3(world[at][3]));
        if (away > farthest[at]) {
            farthest[at] = away;
            flesh.tips[at] = place;
        }
    });
    const bool shows_nothing = std::all_of(
        flesh.vertices.begin(), flesh.vertices.end(), [](std::size_t count) { return count == 0; });
    flesh.is_fleshy.assign(model.nodes.size(), shows_nothing);
    const std::vector<int> order = parents_first(model);
    for (auto node = order.rbegin(); node != order.rend(); ++node) {
        const auto at = static_cast<std::size_t>(*node);
        const int parent = model.nodes[at].parent;
        flesh.is_fleshy[at] = flesh.is_fleshy[at] || flesh.vertices[at] > 0;
        if (parent >= 0 && flesh.is_fleshy[at]) {
            flesh.is_fleshy[static_cast<std::size_t>(parent)] = true;
        }
    }
    return flesh;
}

JointShape::JointShape(const Model& model,
                       std::span<const glm::vec3> places,
                       const NodeFlesh& flesh,
                       const std::vector<bool>& counts)
    : places_(places),
      flesh_(flesh),
      parents_(model.nodes.size(), -1),
      children_(model.nodes.size()),
      reach_(model.nodes.size(), 0.0F),
      tops_(model.nodes.size(), 0.0F) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (!counts[i]) {
            continue;
        }
        int parent = model.nodes[i].parent;
        while (parent >= 0 && !counts[static_cast<std::size_t>(parent)]) {
            parent = node_of(model, parent).parent;
        }
        nodes_.push_back(static_cast<int>(i));
        parents_[i] = parent;
        if (parent >= 0) {
            children_[static_cast<std::size_t>(parent)].push_back(static_cast<int>(i));
        } else {
            roots_.push_back(static_cast<int>(i));
        }
    }
    measure();
}

glm::vec3 JointShape::tip(int node) const {
    return flesh_.is_empty() ? place(node) : flesh_.tips[static_cast<std::size_t>(node)];
}

float JointShape::length_to(int from, int child) const {
    return glm::length(place(child) - place(from)) + reach(child);
}

std::vector<int> JointShape::longest_way(int node) const {
    std::vector<int> way = {node};
    while (!children(way.back()).empty()) {
        const std::vector<int>& next = children(way.back());
        way.push_back(*std::max_element(next.begin(), next.end(), [&](int a, int b) {
            return length_to(way.back(), a) < length_to(way.back(), b);
        }));
    }
    return way;
}

float JointShape::top_above(int node) const {
    float highest = -std::numeric_limits<float>::infinity();
    for (int from = node, up = parent(node); up >= 0; from = up, up = parent(up)) {
        highest = std::max(highest, place(up).y);
        for (const int child : children(up)) {
            highest = child == from ? highest : std::max(highest, top(child));
        }
    }
    return highest;
}

void JointShape::measure() {
    std::vector<int> order = roots_;
    for (std::size_t next = 0; next < order.size(); ++next) {
        order.insert(order.end(), children(order[next]).begin(), children(order[next]).end());
    }
    for (auto node = order.rbegin(); node != order.rend(); ++node) {
        const auto at = static_cast<std::size_t>(*node);
        tops_[at] = place(*node).y;
        if (children(*node).empty()) {
            reach_[at] = glm::distance(tip(*node), place(*node));
        }
        for (const int child : children(*node)) {
            reach_[at] = std::max(reach_[at], length_to(*node, child));
            tops_[at] = std::max(tops_[at], top(child));
        }
    }
    lowest_ = std::numeric_limits<float>::infinity();
    highest_ = -lowest_;
    for (const int node : nodes_) {
        lowest_ = std::min(lowest_, place(node).y);
        highest_ = std::max(highest_, place(node).y);
    }
}

LimbPair JointShape::alike_limbs(int node,
                                 int other,
                                 std::size_t joints,
                                 const std::function<bool(const std::vector<int>&)>& is_fit) const {
    LimbPair best;
    float least = kAlike;
    const std::vector<int>& all = children(node);
    for (std::size_t i = 0; i < all.size() && i < kMostBranches; ++i) {
        for (std::size_t j = i + 1; j < all.size() && j < kMostBranches; ++j) {
            const float longer = std::max(reach(all[i]), reach(all[j]));
            const float difference = std::abs(reach(all[i]) - reach(all[j])) / longer;
            if (all[i] == other || all[j] == other || !(difference < least)) {
                continue;
            }
            const std::vector<int> a = longest_way(all[i]);
            const std::vector<int> b = longest_way(all[j]);
            if (a.size() < joints || b.size() < joints || !is_fit(a) || !is_fit(b)) {
                continue;
            }
            least = difference;
            const bool is_left = place(a.back()).x >= place(b.back()).x;
            best = is_left ? LimbPair{a, b} : LimbPair{b, a};
        }
    }
    return best;
}

}  // namespace raks::render
