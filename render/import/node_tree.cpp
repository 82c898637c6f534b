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

namespace {

std::vector<int> parents_of(const Model& model) {
    std::vector<int> parents;
    parents.reserve(model.nodes.size());
    for (const ModelNode& node : model.nodes) {
        parents.push_back(node.parent);
    }
    return parents;
}

}  // namespace

TreeOrder::TreeOrder(const Model& model) : ParentTree(parents_of(model)) {}

}  // namespace raks::render
