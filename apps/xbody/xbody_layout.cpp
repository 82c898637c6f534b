// Layout of the Xbody pane.
#include <algorithm>

#include "apps/xbody/xbody_pane.hpp"

namespace raks::apps {
namespace {

using render::Box;

constexpr float kMargin = 8.0F;
constexpr float kButton = 26.0F;  // height
constexpr float kRow = 20.0F;
constexpr float kLeft = 270.0F;   // width
constexpr float kRight = 360.0F;  // width

/// `count` equal boxes from left to right.
std::vector<Box> row_of(const Box& box, std::size_t count) {
    constexpr float kGap = 4.0F;
    const float width = (box.width + kGap) / static_cast<float>(count);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        boxes.push_back({box.x + static_cast<float>(i) * width, box.y, width - kGap, box.height});
    }
    return boxes;
}

/// As many rows as there is room for, from the top.
std::vector<Box> rows_of(const Box& box) {
    std::vector<Box> boxes;
    for (float y = box.y; y + kRow <= box.bottom(); y += kRow) {
        boxes.push_back({box.x, y, box.width, kRow - 1.0F});
    }
    return boxes;
}

}  // namespace

XbodyLayout xbody_layout(const Box& area) {
    XbodyLayout layout;
    layout.keys = {kMargin, area.bottom() - kRow - 2.0F, area.width - 2.0F * kMargin, kRow};
    layout.status = {kMargin, layout.keys.y - kRow, layout.keys.width, kRow};
    const float transport = layout.status.y - kMargin - kButton;
    const float bottom = transport - kMargin;

    layout.search = {kMargin, kMargin, kLeft, kButton};
    layout.hide = {kMargin, bottom - kButton, kLeft, kButton};
    const float tree = layout.search.bottom() + 4.0F;
    layout.rows = rows_of({kMargin, tree, kLeft, layout.hide.y - 4.0F - tree});

    const float right = area.right() - kMargin - kRight;
    layout.pages = row_of({right, kMargin, kRight, kButton}, 5);
    const auto buttons = row_of({right, bottom - kButton, kRight, kButton}, 5);
    layout.label = buttons[0];
    layout.unlabel = buttons[1];
    layout.undo = buttons[2];
    layout.redo = buttons[3];
    layout.save = buttons[4];
    layout.axis = {right, layout.label.y - 4.0F - kButton, kRight, kButton};
    layout.lines = rows_of({right, tree, kRight, layout.axis.y - 4.0F - tree});
    for (int i = 0; i < 5; ++i) {
        const float y = tree + static_cast<float>(i) * (kButton + 4.0F);
        layout.films.push_back({right, y, kRight, kButton});
    }

    const float middle = layout.search.right() + kMargin;
    const float width = right - kMargin - middle;
    layout.views = row_of({middle, kMargin, width, kButton}, 5);
    layout.looks = row_of({middle, tree, width, kButton}, 7);
    const float view = layout.looks.front().bottom() + 4.0F;
    layout.view = {middle, view, width, bottom - view};

    layout.steps = row_of({kMargin, transport, kLeft, kButton}, 5);
    layout.number = {middle, transport, 156.0F, kButton};
    layout.slower = {layout.number.right() + kMargin, transport, 26.0F, kButton};
    layout.rate = {layout.slower.right(), transport, 54.0F, kButton};
    layout.faster = {layout.rate.right(), transport, 26.0F, kButton};
    const float line = layout.faster.right() + kMargin;
    layout.timeline = {line, transport, area.right() - kMargin - line, kButton};
    return layout;
}

}  // namespace raks::apps
