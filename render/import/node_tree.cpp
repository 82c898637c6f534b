#include "render/import/node_tree.hpp"

namespace raks::render {

std::vector<int> parents_first(const Model& model) {
    std::vector<int> order;
    order.reserve(model.nodes.size());
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].parent < 0) {
            order.push_back(static_cast<int>(i));
        }
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
        const std::vector<int>& children = node_of(model, order[next]).children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

TreeOrder::TreeOrder(const Model& model)
    : begin_(model.nodes.size(), 0), size_(model.nodes.size(), 1), depth_(model.nodes.size(), 0) {
    const std::vector<int> order = parents_first(model);
    for (auto node = order.rbegin(); node != order.rend(); ++node) {
        if (const int parent = node_of(model, *node).parent; parent >= 0) {
            size_[static_cast<std::size_t>(parent)] += size_[static_cast<std::size_t>(*node)];
        }
    }
    int root_begin = 0;
    for (const int node : order) {
        const auto at = static_cast<std::size_t>(node);
        if (node_of(model, node).parent < 0) {
            begin_[at] = root_begin;
            root_begin += size_[at];
        }
        int begin = begin_[at] + 1;
        for (const int child : node_of(model, node).children) {
            const auto below = static_cast<std::size_t>(child);
            begin_[below] = begin;
            begin += size_[below];
            depth_[below] = depth_[at] + 1;
        }
    }
}

}  // namespace raks::render
