#include <algorithm>
#include <cstddef>
#include <string_view>

#include "render/overlay/panels.hpp"
#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

// Sizes in the pen's units.
constexpr float kListEdge = 22.0F;
constexpr float kListMargin = 6.0F;  // between the panel and the picture's edge
constexpr float kTabsHeight = 34.0F;
constexpr float kTypedHeight = 32.0F;
constexpr float kHintHeight = 22.0F;
constexpr float kRowPitch = 30.0F;  // from one row to the next
constexpr float kMostRows = 12.0F;
constexpr float kLevelMeter = 84.0F;
constexpr float kCheckBox = 15.0F;  // a side of the box before a row

/// Where the parts of a list lie.
struct ListLayout {
    Box panel;
    std::size_t first = 0;  // row that is seen
    std::size_t count = 0;  // rows that are seen

    [[nodiscard]] float left() const { return panel.x + kListEdge; }
    [[nodiscard]] float right() const { return panel.right() - kListEdge; }
    [[nodiscard]] float rows_top() const {
        return panel.y + kListEdge / 2.0F + kTabsHeight + kTypedHeight;
    }
};

/// As many rows as there is room for, the chosen one among them, near the middle.
ListLayout list_layout(const OverlayList& list, const Canvas& canvas) {
    constexpr float kFrame = kListEdge + kTabsHeight + kTypedHeight + kHintHeight;
    const float room = (canvas.height - kFrame - 2.0F * kListMargin) / kRowPitch;
    const auto most = static_cast<std::size_t>(std::clamp(room, 1.0F, kMostRows));
    ListLayout layout;
    layout.count = std::min(most, list.rows.size());
    const std::size_t before = std::min(list.chosen, most / 2);
    layout.first = std::min(list.chosen - before, list.rows.size() - layout.count);
    const float width = std::min(kListPanelWidth, canvas.width - 2.0F * kListMargin);
    const float height =
        kFrame + kRowPitch * static_cast<float>(std::max<std::size_t>(layout.count, 1));
    layout.panel = {(canvas.width - width) / 2.0F, (canvas.height - height) / 2.0F, width, height};
    return layout;
}

/// The pages' titles side by side, the open one underlined.
void draw_tabs(const Pen& pen,
               const OverlayList& list,
               const ListLayout& layout,
               OverlayControls& controls) {
    const ImFont* const font = pen.fonts().bold;
    float x = layout.left();
    const float y = layout.panel.y + kListEdge / 2.0F + 4.0F;
    for (std::size_t i = 0; i < list.pages.size(); ++i) {
        const bool is_open = i == list.page;
        const float width = pen.text(font,
                                     x,
                                     y,
                                     is_open ? palette::kText : palette::kDim,
                                     list.pages[i],
                                     Align::left,
                                     std::max(layout.right() - x, 1.0F));
        const Box tab{x - 6.0F, y - 6.0F, width + 12.0F, kTabsHeight - 4.0F};
        if (is_open && list.pages.size() > 1) {
            pen.fill({x, y + pen.height_of(font) + 3.0F, width, 2.0F}, palette::kAmber);
        }
        controls.spots.push_back({area_of(pen, tab), {PanelPart::list_page, i}});
        x += width + 26.0F;
    }
}

/// What was typed, or what typing does.
void draw_typed(const Pen& pen, const OverlayList& list, const ListLayout& layout) {
    const Box field{layout.left(),
                    layout.panel.y + kListEdge / 2.0F + kTabsHeight,
                    layout.right() - layout.left(),
                    kTypedHeight - 8.0F};
    pen.fill(field, palette::kTrough, 5.0F);
    const ImFont* const font = pen.fonts().body;
    const float y = field.y + (field.height - pen.height_of(font)) / 2.0F;
    const bool is_typed = !list.typed.empty();
    const float width = pen.text(font,
                                 field.x + 8.0F,
                                 y,
                                 is_typed ? palette::kText : palette::kDim,
                                 is_typed ? list.typed : list.prompt,
                                 Align::left,
                                 field.width - 20.0F);
    if (is_typed) {
        pen.fill({field.x + 10.0F + width, y, 1.5F, pen.height_of(font)}, palette::kAmber);
    }
}

/// A box, checked or not.
void draw_box(const Pen& pen, const Box& box, bool is_checked) {
    pen.outline(box, palette::kDim, 3.0F);
    if (is_checked) {
        pen.fill(box.inside(3.5F), palette::kTeal, 2.0F);
    }
}

/// One row: box, name, what is said of it, meter.
void draw_list_row(const Pen& pen,
                   const ListRow& row,
                   bool is_chosen,
                   const Box& place,
                   OverlaySpot spot,
                   OverlayControls& controls) {
    const ImFont* const font = row.is_title ? pen.fonts().small : pen.fonts().body;
    const float y = place.y + (place.height - pen.height_of(font)) / 2.0F;
    if (row.is_title) {
        pen.text(font, place.x, y + 3.0F, palette::kAmber, row.text);
        return;
    }
    const Box bar{place.x - 8.0F, place.y + 1.0F, place.width + 16.0F, place.height - 2.0F};
    if (is_chosen) {
        pen.fill(bar, {0xFFFFFF, 0.12F}, 5.0F);
    }
    controls.spots.push_back({area_of(pen, bar), spot});
    float x = place.x;
    if (row.is_checked) {
        const Box box{x, place.y + (place.height - kCheckBox) / 2.0F, kCheckBox, kCheckBox};
        draw_box(pen, box, *row.is_checked);
        spot.part = PanelPart::list_box;
        controls.spots.push_back({area_of(pen, box.inside(-6.0F)), spot});
        x = box.right() + 12.0F;
    }
    if (row.is_current) {
        pen.dot(x + 3.0F, place.y + place.height / 2.0F, 3.0F, palette::kAmber);
    }
    x += 14.0F;
    float right = place.right();
    if (row.level_dbfs) {
        right -= kLevelMeter;
        pen.bar({right, place.y + place.height / 2.0F - 2.5F, kLevelMeter, 5.0F},
                meter_fraction(*row.level_dbfs),
                palette::kTeal);
        right -= 12.0F;
    }
    const bool is_off = row.is_checked && !*row.is_checked;
    const float width = pen.text(font,
                                 x,
                                 y,
                                 is_off ? palette::kDim : palette::kText,
                                 row.text,
                                 Align::left,
                                 std::max(right - x, 1.0F));
    const float left = x + width + 12.0F;
    const ImFont* const small = pen.fonts().small;
    if (right - left > 24.0F) {
        pen.text(small,
                 left,
                 place.y + (place.height - pen.height_of(small)) / 2.0F + 1.0F,
                 palette::kDim,
                 row.detail,
                 Align::left,
                 right - left);
    }
}

}  // namespace

void draw_list(const Pen& pen,
               const OverlayList& list,
               const Canvas& canvas,
               OverlayControls& controls) {
    const ListLayout layout = list_layout(list, canvas);
    pen.fill(layout.panel, {0x0C0E1A, 0.93F}, 12.0F);
    pen.outline(layout.panel, palette::kEdge, 12.0F);
    controls.spots.push_back({area_of(pen, layout.panel), {PanelPart::ground}});
    draw_tabs(pen, list, layout, controls);
    draw_typed(pen, list, layout);
    for (std::size_t i = 0; i < layout.count; ++i) {
        const std::size_t number = layout.first + i;
        const Box place{layout.left(),
                        layout.rows_top() + kRowPitch * static_cast<float>(i),
                        layout.right() - layout.left(),
                        kRowPitch};
        draw_list_row(pen,
                      list.rows[number],
                      number == list.chosen,
                      place,
                      {PanelPart::list_row, number},
                      controls);
    }
    const float foot = layout.panel.bottom() - kListEdge / 2.0F - kHintHeight + 8.0F;
    pen.text(pen.fonts().small,
             layout.left(),
             foot,
             palette::kDim,
             list.hint,
             Align::left,
             layout.right() - layout.left());
}

}  // namespace raks::render
