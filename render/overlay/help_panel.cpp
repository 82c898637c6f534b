#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

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
constexpr float kWideWidth = 2.0F * kColumnWidth + 2.0F * kEdge;
constexpr float kKeysWidth = 172.0F;
constexpr float kLeftOutHeight = 22.0F;  // of the line that says what is left out

/// A key as a small cap; returns its width.
float draw_cap(const Pen& pen, std::string_view name, float x, float y, float height) {
    const ImFont* const font = pen.fonts().small;
    const float width = std::max(pen.width_of(font, name) + 14.0F, 22.0F);
    const Box cap{x, y, width, height};
    pen.fill(cap, {0xFFFFFF, 0.10F}, 5.0F);
    pen.outline(cap, {0xFFFFFF, 0.16F}, 5.0F);
    pen.text(font,
             x + width / 2.0F,
             y + (cap.height - pen.height_of(font)) / 2.0F,
             palette::kText,
             name,
             Align::middle);
    return width;
}

/// The keys of one line as caps, then what they do, from a fixed place on.
void draw_row(const Pen& pen, const HelpRow& row, float x, float y, float pitch) {
    // Caps shrink with the pitch, so that those of two lines never touch.
    const float height = std::min(kCapHeight, pitch - kLeastGap);
    float key_x = x;
    for (const std::string& key : row.keys) {
        key_x += draw_cap(pen, key, key_x, y, height) + 6.0F;
    }
    const OverlayFonts& fonts = pen.fonts();
    // Many or long keys push their text on instead of running over it.
    const float text_x = std::max(x + kKeysWidth, key_x + 2.0F);
    pen.text(fonts.body,
             text_x,
             y + (height - pen.height_of(fonts.body)) / 2.0F,
             palette::kText,
             row.text,
             Align::left,
             x + kColumnWidth - text_x - 6.0F);
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

/// One or two columns, how far apart their lines are, and how many lines had no room.
struct Layout {
    std::span<const HelpRow> left;
    std::span<const HelpRow> right;
    float pitch = kMostPitch;
    std::size_t left_out = 0;

    [[nodiscard]] float height() const {
        return std::max(height_of(left, pitch), height_of(right, pitch)) +
               (left_out > 0 ? kLeftOutHeight : 0.0F);
    }
};

/// Lines move together where the picture is low; they never cover one another.
float pitch_of(const Layout& layout, float room) {
    float pitch = kMostPitch;
    for (const std::span<const HelpRow> column : {layout.left, layout.right}) {
        const float lines = static_cast<float>(std::max<std::size_t>(1, column.size()));
        pitch = std::min(pitch, (room - height_of_titles(column)) / lines);
    }
    return std::max(pitch, kLeastPitch);
}

/// The first lines of a column that have room when they are as close as they may be.
std::span<const HelpRow> fitting(std::span<const HelpRow> column, float room) {
    std::size_t count = column.size();
    while (count > 0 && height_of(column.first(count), kLeastPitch) > room) {
        --count;
    }
    return column.first(count);
}

/// Breaks between the two groups where the taller column is lowest. A single group is never
/// divided: it stays in one column.
Layout two_columns(std::span<const HelpRow> rows) {
    Layout best{rows, {}};
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Layout layout{rows.first(i), rows.subspan(i)};
        if (begins_group(rows, i) && layout.height() < best.height()) {
            best = layout;
        }
    }
    return best;
}

/// Sets the pitch, and leaves out what has no room even so.
Layout layout_of(std::span<const HelpRow> rows, bool has_two_columns, float room) {
    Layout layout = has_two_columns ? two_columns(rows) : Layout{rows, {}};
    layout.pitch = pitch_of(layout, room);
    if (std::max(height_of(layout.left, kLeastPitch), height_of(layout.right, kLeastPitch)) >
        room) {
        layout.left = fitting(layout.left, room - kLeftOutHeight);
        layout.right = fitting(layout.right, room - kLeftOutHeight);
        layout.left_out = rows.size() - layout.left.size() - layout.right.size();
    }
    return layout;
}

/// Titles and lines from (x, y) downward.
void draw_column(const Pen& pen, std::span<const HelpRow> rows, float pitch, float x, float y) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (begins_group(rows, i)) {
            y += i == 0 ? 0.0F : kGroupGap;
            pen.text(pen.fonts().small, x, y, palette::kAmber, rows[i].group);
            y += kTitleHeight;
        }
        draw_row(pen, rows[i], x, y, pitch);
        y += pitch;
    }
}

}  // namespace

bool has_room_beside_help(const Canvas& canvas) noexcept {
    return canvas.width >= kWideWidth + 2.0F * (kMargin + kCardWidth + kMargin / 2.0F);
}

void draw_help(const Pen& pen, std::span<const HelpRow> rows, const Canvas& canvas) {
    const float frame = 2.0F * kEdge + kHeadHeight;
    const bool is_wide = canvas.width >= kWideWidth;
    // What the panel's own edges and title leave of the picture is the lines' room.
    const Layout layout = layout_of(rows, is_wide, canvas.height - frame - 2.0F * kLeastMargin);
    const float width = is_wide ? kWideWidth : kNarrowWidth;
    const float height = layout.height() + frame;
    const Box box{(canvas.width - width) / 2.0F, (canvas.height - height) / 2.0F, width, height};
    pen.fill(box, {0x0C0E1A, 0.93F}, 12.0F);
    pen.outline(box, palette::kEdge, 12.0F);
    const float x = box.x + kEdge;
    const float y = box.y + kEdge - 4.0F;
    pen.text(pen.fonts().bold, x, y, palette::kText, "Keys");
    pen.text(pen.fonts().small,
             box.right() - kEdge,
             y + 4.0F,
             palette::kDim,
             "drag: turn   wheel: zoom   right drag: move",
             Align::right);
    draw_column(pen, layout.left, layout.pitch, x, y + kHeadHeight);
    draw_column(pen, layout.right, layout.pitch, x + kColumnWidth, y + kHeadHeight);
    if (layout.left_out > 0) {
        pen.text(pen.fonts().small,
                 x,
                 box.bottom() - kEdge - kLeftOutHeight + 8.0F,
                 palette::kDim,
                 fmt::format("{} more in a larger window", layout.left_out));
    }
}

}  // namespace raks::render
