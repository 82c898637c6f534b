#include "apps/xbody/model_tree.hpp"

#include <gtest/gtest.h>

namespace raks::apps {
namespace {

/// root with hips (spine, leg) and mesh.
render::Model small_model() {
    render::Model model;
    const auto add = [&model](const char* name, int parent) {
        const int node = static_cast<int>(model.nodes.size());
        render::ModelNode& added = model.nodes.emplace_back();
        added.name = name;
        added.parent = parent;
        if (parent >= 0) {
            model.nodes[static_cast<std::size_t>(parent)].children.push_back(node);
        }
    };
    add("root", -1);
    add("Hips", 0);
    add("Spine", 1);
    add("leg", 1);
    add("mesh", 0);
    model.roots = {0};
    return model;
}

TEST(ModelTree, rows_follow_the_tree_and_a_folded_branch_is_one_row) {
    const render::Model model = small_model();
    TreeView view = tree_view(model);
    const std::vector<TreeRow> all = {
        {0, 0, true}, {1, 1, true}, {2, 2, false}, {3, 2, false}, {4, 1, false}};
    EXPECT_EQ(tree_rows(model, view), all);
    view.is_folded[1] = true;
    const std::vector<TreeRow> folded = {{0, 0, true}, {1, 1, true}, {4, 1, false}};
    EXPECT_EQ(tree_rows(model, view), folded);
}

TEST(ModelTree, a_search_finds_names_in_any_case_also_in_folded_branches) {
    const render::Model model = small_model();
    TreeView view = tree_view(model);
    view.is_folded[1] = true;
    view.search = "sPi";
    const std::vector<TreeRow> found = {{0, 0, true}, {1, 1, true}, {2, 2, false}};
    EXPECT_EQ(tree_rows(model, view), found);
    view.search = "none such";
    EXPECT_TRUE(tree_rows(model, view).empty());
}

TEST(ModelTree, a_branch_is_hidden_and_shown_with_all_below_it) {
    const render::Model model = small_model();
    TreeView view = tree_view(model);
    toggle_branch(model, 1, view);
    EXPECT_EQ(view.is_hidden, (std::vector<bool>{false, true, true, true, false}));
    toggle_branch(model, 1, view);
    EXPECT_EQ(view.is_hidden, std::vector<bool>(5, false));
}

}  // namespace
}  // namespace raks::apps
