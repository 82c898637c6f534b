#include "apps/xbody/model_tree.hpp"

#include <algorithm>
#include <cctype>

namespace raks::apps {
namespace {

std::size_t slot(int index) { return static_cast<std::size_t>(index); }

std::string lower(const std::string& text) {
    std::string low = text;
    std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) {
        return static_cast<char>(c < 128 ? std::tolower(c) : c);
    });
    return low;
}

// Nodes that match, and all above them.
std::vector<bool> found_nodes(const render::Model& model, const std::string& search) {
    const std::string wanted = lower(search);
    std::vector<bool> is_found(model.nodes.size(), false);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (lower(model.nodes[i].name).find(wanted) != std::string::npos) {
            for (int up = static_cast<int>(i); up >= 0 && !is_found[slot(up)];
                 up = model.nodes[slot(up)].parent) {
                is_found[slot(up)] = true;
            }
        }
    }
    return is_found;
}

}  // namespace

TreeView tree_view(const render::Model& model) {
    return {std::vector<bool>(model.nodes.size(), false),
            std::vector<bool>(model.nodes.size(), false),
            {}};
}

std::vector<TreeRow> tree_rows(const render::Model& model, const TreeView& view) {
    const bool is_searched = !view.search.empty();
    const std::vector<bool> is_found =
        is_searched ? found_nodes(model, view.search) : std::vector<bool>();
    std::vector<TreeRow> open;  // the next one last
    for (std::size_t i = model.nodes.size(); i-- > 0;) {
        if (model.nodes[i].parent < 0) {
            open.push_back({static_cast<int>(i), 0, false});
        }
    }
    std::vector<TreeRow> rows;
    while (!open.empty()) {
        TreeRow row = open.back();
        open.pop_back();
        if (is_searched && !is_found[slot(row.node)]) {
            continue;
        }
        const std::vector<int>& children = model.nodes[slot(row.node)].children;
        row.has_children = !children.empty();
        rows.push_back(row);
        if (is_searched || !view.is_folded[slot(row.node)]) {
            for (auto child = children.rbegin(); child != children.rend(); ++child) {
                open.push_back({*child, row.depth + 1, false});
            }
        }
    }
    return rows;
}

void toggle_branch(const render::Model& model, int node, TreeView& view) {
    const bool is_hidden = !view.is_hidden[slot(node)];
    std::vector<int> open = {node};
    for (std::size_t i = 0; i < open.size(); ++i) {
        view.is_hidden[slot(open[i])] = is_hidden;
        const std::vector<int>& children = model.nodes[slot(open[i])].children;
        open.insert(open.end(), children.begin(), children.end());
    }
}

}  // namespace raks::apps
