// Model tree: the nodes of a model as rows that fold, are searched, and hidden with all below them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/model/model.hpp"

namespace raks::apps {

/// A row of the tree.
struct TreeRow {
    int node = -1;
    int depth = 0;
    bool has_children = false;
    friend bool operator==(const TreeRow&, const TreeRow&) = default;
};

/// What a person does with the tree.
struct TreeView {
    std::vector<bool> is_folded;  ///< by node: what lies below it is not shown
    std::vector<bool> is_hidden;  ///< by node: it is not drawn
    std::string search;           ///< empty: all rows
};

/// A view of all nodes.
[[nodiscard]] TreeView tree_view(const render::Model& model);

/// The rows, from the top. With a search: nodes whose names hold it, in any case of ASCII letters,
/// folded or not, and what they hang on.
[[nodiscard]] std::vector<TreeRow> tree_rows(const render::Model& model, const TreeView& view);

/// Hides a node with all below it, or shows them again where it was hidden.
void toggle_branch(const render::Model& model, int node, TreeView& view);

}  // namespace raks::apps
