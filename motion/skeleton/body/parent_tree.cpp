#include "motion/skeleton/body/parent_tree.hpp"

namespace raks::motion {

ParentTree::ParentTree(std::span<const int> parents)
    : parents_(parents.begin(), parents.end()),
      children_(parents.size()),
      begin_(parents.size(), 0),
      size_(parents.size(), 1),
      depth_(parents.size(), 0) {
    for (std::size_t i = 0; i < parents_.size(); ++i) {
        if (parents_[i] < 0) {
            roots_.push_back(static_cast<int>(i));
        } else {
            children_[static_cast<std::size_t>(parents_[i])].push_back(static_cast<int>(i));
        }
    }
    order_ = roots_;
    for (std::size_t next = 0; next < order_.size(); ++next) {
        const std::vector<int>& below = children(order_[next]);
        order_.insert(order_.end(), below.begin(), below.end());
    }
    for (auto node = order_.rbegin(); node != order_.rend(); ++node) {
        if (const int above = parent(*node); above >= 0) {
            size_[static_cast<std::size_t>(above)] += size_[static_cast<std::size_t>(*node)];
        }
    }
    int root_begin = 0;
    for (const int node : order_) {
        const auto at = static_cast<std::size_t>(node);
        if (parents_[at] < 0) {
            begin_[at] = root_begin;
            root_begin += size_[at];
        }
        int begin = begin_[at] + 1;
        for (const int child : children(node)) {
            const auto below = static_cast<std::size_t>(child);
            begin_[below] = begin;
            begin += size_[below];
            depth_[below] = depth_[at] + 1;
        }
    }
}

int ParentTree::carrier_of(int a, int b) const {
    for (int up = a; up >= 0 && b >= 0; up = parent(up)) {
        if (up == b || is_below(b, up)) {
            return up;
        }
    }
    return -1;
}

}  // namespace raks::motion
