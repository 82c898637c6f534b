#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/overlay/panels.hpp"

namespace raks::render {
namespace {

// Sizes in the pen's units.
constexpr float kColumnWidth = 346.0F;
constexpr float kMostPitch = 25.0F;  // from one line to the next, where there is room
constexpr float kLeastPitch = 18.0F;
constexpr float kCapHeight = 20.0F;
constexpr float kLeastGap = 2.0F;  // between the caps of two lines
constexpr float kTitleHeight = 22.0F;
constexpr float kGroupGap = 14.0F;
constexpr float kEdge = 26.0F;
constexpr float kHeadHeight = 38.0F;
constexpr float kLeastMargin = 6.0F;                         // above and below the panel
constexpr float kNarrowWidth = kColumnWidth + 2.0F * kEdge;  // one column
static_assert(kKeysPanelWidth == 2.0F * kColumnWidth + 2.0F * kEdge);
constexpr float kKeysWidth = 172.0F;
constexpr std::size_t kFewKeys = 4;  // more on one line, such as nine digits, are narrow

/// How wide a key's cap is beside its name and at least, and the gap to the next.
struct CapSizes {
    float around = 14.0F;
    float least = 22.0F;
    float gap = 6.0F;
};
constexpr CapSizes kNarrowCap{.around = 8.0F, .least = 16.0F, .gap = 2.0F};

/// A key as a small cap.
Box draw_cap(
    const Pen& pen, std::string_view name, const CapSizes& sizes, float x, float y, float height) {
    const ImFont* const font = pen.fonts().small;
    const float width = std::max(pen.width_of(font, name) + sizes.around, sizes.least);
    const Box cap{x, y, width, height};
    pen.fill(cap, {0xFFFFFF, 0.10F}, 5.0F);
    pen.outline(cap, {0xFFFFFF, 0.16F}, 5.0F);
    pen.text(font,
             x + width / 2.0F,
             y + (cap.height - pen.height_of(font)) / 2.0F,
             palette::kText,
             name,
             Align::middle);
    return cap;
}

/// Lines that follow one another; `first` is the number of the first in all of the list.
struct Lines {
    std::span<const HelpRow> rows;
    std::size_t first = 0;

    [[nodiscard]] Lines part(std::size_t from, std::size_t count) const {
        return {rows.subspan(from, count), first + from};
    }
    [[nodiscard]] Lines from(std::size_t at) const { return part(at, rows.size() - at); }
    [[nodiscard]] std::size_t size() const { return rows.size(); }
};

/// The keys of one line as caps, then what they do, from a fixed place on. A line of one key can be
/// clicked all along.
void draw_row(const Pen& pen,
              const HelpRow& row,
              std::size_t number,
              const Box& place,
              OverlayControls& controls) {
    // Caps shrink with the pitch, so that those of two lines never touch.
    const float height = std::min(kCapHeight, place.height - kLeastGap);
    const auto add = [&](const Box& box, std::size_t item) {
        controls.spots.push_back({area_of(pen, box), {PanelPart::key, number, item}});
    };
    if (row.keys.size() == 1) {
        add({place.x, place.y, place.width - 6.0F, height}, 0);
    }
    const CapSizes sizes = row.keys.size() > kFewKeys ? kNarrowCap : CapSizes();
    float key_x = place.x;
    for (std::size_t i = 0; i < row.keys.size(); ++i) {
        const Box cap = draw_cap(pen, row.keys[i], sizes, key_x, place.y, height);
        add(cap, i);
        key_x = cap.right() + sizes.gap;
    }
    const OverlayFonts& fonts = pen.fonts();
    // Many or long keys push their text on instead of running over it.
    const float text_x = std::max(place.x + kKeysWidth, key_x + 2.0F);
    pen.text(fonts.body,
             text_x,
             place.y + (height - pen.height_of(fonts.body)) / 2.0F,
             palette::kText,
             row.text,
             Align::left,
             place.right() - text_x - 6.0F);
}

/// Whether line i has a title above it.
bool begins_group(std::span<const HelpRow> rows, std::size_t i) {
    return i == 0 || rows[i].group != rows[i - 1].group;
}

/// All of a column but its lines: titles and the gaps between groups.
float height_of_titles(std::span<const HelpRow> rows) {
    float height = 0.0F;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (begins_group(rows, i)) {
            height += kTitleHeight + (i == 0 ? 0.0F : kGroupGap);
        }
    }
    return height;
}

/// Height of a column, units.
float height_of(std::span<const HelpRow> rows, float pitch) {
    return height_of_titles(rows) + static_cast<float>(rows.size()) * pitch;
}

/// One page: one or two columns, and how far apart their lines are.
struct Layout {
    Lines left;
    Lines right;
    float pitch = kMostPitch;

    [[nodiscard]] float height() const {
        return std::max(height_of(left.rows, pitch), height_of(right.rows, pitch));
    }
};

/// Lines move together where the picture is low; they never cover one another.
float pitch_of(const Layout& layout, float room) {
    float pitch = kMostPitch;
    for (const Lines& column : {layout.left, layout.right}) {
        const float lines = static_cast<float>(std::max<std::size_t>(1, column.size()));
        pitch = std::min(pitch, (room - height_of_titles(column.rows)) / lines);
    }
    return std::max(pitch, kLeastPitch);
}

/// How many of the first lines have room when they are as close as they may be; at least one.
std::size_t fitting(const Lines& lines, float room) {
    std::size_t count = lines.size();
    while (count > 1 && height_of(lines.rows.first(count), kLeastPitch) > room) {
        --count;
    }
    return count;
}

/// Breaks between the two groups where the taller column is lowest. A single group is never
/// divided: it stays in one column.
Layout two_columns(const Lines& lines) {
    Layout best{lines, {}};
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const Layout layout{lines.part(0, i), lines.from(i)};
        if (begins_group(lines.rows, i) && layout.height() < best.height()) {
            best = layout;
        }
    }
    return best;
}

/// All lines on one page where they have room, else as many on each as have.
std::vector<Layout> pages_of(const Lines& lines, bool has_two_columns, float room) {
    Layout whole = has_two_columns ? two_columns(lines) : Layout{lines, {}};
    whole.pitch = pitch_of(whole, room);
    if (whole.height() <= room) {
        return {whole};
    }
    std::vector<Layout> pages;
    for (Lines rest = lines; rest.size() > 0;) {
        Layout page{rest.part(0, fitting(rest, room)), {}, kLeastPitch};
        rest = rest.from(page.left.size());
        if (has_two_columns && rest.size() > 0) {
            page.right = rest.part(0, fitting(rest, room));
            rest = rest.from(page.right.size());
        }
        pages.push_back(page);
    }
    return pages;
}

/// Titles and lines from (x, y) downward.
void draw_column(
    const Pen& pen, const Lines& lines, float pitch, float x, float y, OverlayControls& controls) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (begins_group(lines.rows, i)) {
            y += i == 0 ? 0.0F : kGroupGap;
            pen.text(pen.fonts().small, x, y, palette::kAmber, lines.rows[i].group);
            y += kTitleHeight;
        }
        draw_row(pen, lines.rows[i], lines.first + i, {x, y, kColumnWidth, pitch}, controls);
        y += pitch;
    }
}

/// The title, and at its right what the mouse does, or which page this is. All of it can be
/// clicked.
void draw_head(const Pen& pen,
               const Box& box,
               std::size_t page,
               std::size_t pages,
               OverlayControls& controls) {
    const float x = box.x + kEdge;
    const float y = box.y + kEdge - 4.0F;
    pen.text(pen.fonts().bold, x, y, palette::kText, "Keys");
    const std::string aside = pages > 1
                                  ? fmt::format("page {} of {}: ? turns it", page + 1, pages)
                                  : std::string("drag: turn   wheel: zoom   right drag: move");
    pen.text(pen.fonts().small, box.right() - kEdge, y + 4.0F, palette::kDim, aside, Align::right);
    controls.spots.push_back({area_of(pen, {box.x, box.y, box.width, kHeadHeight + kEdge - 4.0F}),
                              {PanelPart::keys_head}});
}

}  // namespace

bool has_room_beside(float width, const Canvas& canvas) noexcept {
    return canvas.width >= width + 2.0F * (kMargin + kCardWidth + kMargin / 2.0F);
}

OverlayControls::Area area_of(const Pen& pen, const Box& box) noexcept {
    const float unit = pen.unit();
    return {box.x * unit, box.y * unit, box.right() * unit, box.bottom() * unit};
}

void draw_help(const Pen& pen,
               std::span<const HelpRow> rows,
               std::size_t page,
               const Canvas& canvas,
               OverlayControls& controls) {
    const float frame = 2.0F * kEdge + kHeadHeight;
    const bool is_wide = canvas.width >= kKeysPanelWidth;
    // What the panel's own edges and title leave of the picture is the lines' room.
    const std::vector<Layout> pages =
        pages_of({rows}, is_wide, canvas.height - frame - 2.0F * kLeastMargin);
    const std::size_t at = page % pages.size();
    const Layout& layout = pages[at];
    const float width = is_wide ? kKeysPanelWidth : kNarrowWidth;
    const float height = layout.height() + frame;
    const Box box{(canvas.width - width) / 2.0F, (canvas.height - height) / 2.0F, width, height};
    pen.fill(box, {0x0C0E1A, 0.93F}, 12.0F);
    pen.outline(box, palette::kEdge, 12.0F);
    controls.help_pages = pages.size();
    controls.spots.push_back({area_of(pen, box), {PanelPart::ground}});
    draw_head(pen, box, at, pages.size(), controls);
    const float x = box.x + kEdge;
    const float y = box.y + kEdge - 4.0F + kHeadHeight;
    draw_column(pen, layout.left, layout.pitch, x, y, controls);
    draw_column(pen, layout.right, layout.pitch, x + kColumnWidth, y, controls);
}

}  // namespace raks::render
