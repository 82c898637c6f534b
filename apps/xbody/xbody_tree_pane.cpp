// The tree of the Xbody pane.
#include <algorithm>
#include <string_view>

#include "apps/xbody/xbody_drawing.hpp"
#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using render::Box;

namespace palette = render::palette;

/// The tree while it is drawn.
class TreePane {
 public:
    explicit TreePane(XbodyDrawing& drawing) : d_(drawing) {}

    void search() {
        const render::PaneItem item = pane_item(d_.layout.search, "search", d_.frame);
        d_.pen().fill(d_.layout.search, render::pane_colours::kSunken, 5.0F);
        d_.pen().outline(d_.layout.search,
                         d_.session.is_searching ? palette::kTeal : render::pane_colours::kLine,
                         5.0F);
        const std::string& wanted = d_.session.tree.search;
        const std::string shown = d_.session.is_searching ? wanted + "_"
                                  : wanted.empty()        ? "Search a node: /"
                                                          : wanted;
        d_.text({d_.layout.search.x, d_.layout.search.y + 3.0F, d_.layout.search.width, 20.0F},
                8.0F,
                wanted.empty() ? palette::kDim : palette::kText,
                shown);
        if (item.is_clicked) {
            d_.wish(SearchNodes{wanted, true});
        }
    }

    void tree() {
        const std::vector<TreeRow> rows = tree_rows(*d_.session.model, d_.session.tree);
        reveal(rows);
        const std::size_t begin = d_.list_begin(d_.layout.rows, d_.session.first_row, rows.size());
        if (const auto first = d_.scrolled(d_.layout.rows, begin, rows.size())) {
            d_.wish(ScrollTree{*first});
        }
        for (std::size_t i = 0; i < d_.layout.rows.size() && begin + i < rows.size(); ++i) {
            tree_row(d_.layout.rows[i], rows[begin + i]);
        }
        const bool is_hidden =
            d_.session.node &&
            d_.session.tree.is_hidden[static_cast<std::size_t>(*d_.session.node)];
        if (d_.button(d_.layout.hide,
                      is_hidden ? "Show this branch (H)" : "Hide this branch (H)",
                      d_.session.node.has_value())) {
            d_.wish(HideBranch{*d_.session.node});
        }
    }

 private:
    // A node that was chosen elsewhere comes into the rows.
    void reveal(const std::vector<TreeRow>& rows) {
        if (!d_.session.is_node_to_see) {
            return;
        }
        const auto found = std::find_if(rows.begin(), rows.end(), [this](const TreeRow& row) {
            return d_.session.node == row.node;
        });
        const auto index = static_cast<std::size_t>(found - rows.begin());
        const std::size_t room = d_.layout.rows.size();
        const bool is_in = index >= d_.session.first_row && index < d_.session.first_row + room;
        d_.wish(ScrollTree{is_in || found == rows.end() ? d_.session.first_row
                                                        : index - std::min(index, room / 2)});
    }

    void tree_row(const Box& box, const TreeRow& row) {
        constexpr float kIndent = 10.0F;
        constexpr int kDeepest = 12;  // that is indented
        const auto index = static_cast<std::size_t>(row.node);
        const std::string id = fmt::format("node {}", row.node);
        const float indent = kIndent * static_cast<float>(std::min(row.depth, kDeepest));
        const render::PaneItem item = pane_item(box, id, d_.frame);
        const bool is_chosen = d_.session.node == row.node;
        if (is_chosen || item.is_hovered) {
            d_.pen().fill(box,
                          is_chosen ? render::pane_colours::kChosen : render::pane_colours::kRaised,
                          4.0F);
        }
        const float middle = box.y + box.height / 2.0F;
        const float left = box.x + indent;
        if (row.has_children) {
            fold_mark({left + 2.0F, middle}, d_.session.tree.is_folded[index]);
        }
        d_.pen().dot(left + 18.0F, middle, 4.0F, colour_of(d_.view.kinds[index]));
        const std::string_view kind = words_of(d_.view.kinds[index]);
        const float note = d_.pen().width_of(d_.pen().fonts().small, kind);
        const std::string& name = d_.session.model->nodes[index].name;
        d_.text({box.x, box.y, box.width - note - 8.0F, box.height},
                indent + 26.0F,
                d_.session.tree.is_hidden[index] ? palette::kDim.faded(0.5F) : palette::kText,
                name.empty() ? fmt::format("(node {})", row.node) : printable(name, 60));
        d_.pen().text(d_.pen().fonts().small,
                      box.right() - 4.0F,
                      box.y + 3.0F,
                      palette::kDim,
                      kind,
                      render::Align::right);
        if (item.is_clicked) {
            const bool is_fold = row.has_children && d_.frame.pointer.x < left + 12.0F;
            d_.wish(is_fold ? XbodyAction(FoldBranch{row.node})
                            : XbodyAction(ChooseNode{row.node}));
        }
    }

    void fold_mark(const glm::vec2& at, bool is_folded) const {
        if (is_folded) {
            d_.pen().triangle(
                {at.x, at.y - 4.0F}, {at.x + 6.0F, at.y}, {at.x, at.y + 4.0F}, palette::kDim);
        } else {
            d_.pen().triangle({at.x - 1.0F, at.y - 3.0F},
                              {at.x + 7.0F, at.y - 3.0F},
                              {at.x + 3.0F, at.y + 4.0F},
                              palette::kDim);
        }
    }

    XbodyDrawing& d_;
};

}  // namespace

void draw_tree(XbodyDrawing& drawing) {
    TreePane pane(drawing);
    pane.search();
    pane.tree();
}

}  // namespace raks::apps
