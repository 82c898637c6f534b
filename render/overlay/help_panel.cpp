#include <algorithm>
#include <string_view>
#include <vector>

#include "render/overlay/key_bindings.hpp"
#include "render/overlay/panels.hpp"

namespace raks::render {
namespace {

constexpr float kColumnWidth = 288.0F;
constexpr float kRowHeight = 25.0F;
constexpr float kCapHeight = 20.0F;
constexpr float kTitleHeight = 30.0F;
constexpr float kGroupGap = 14.0F;
constexpr float kEdge = 26.0F;
constexpr float kWidth = 2.0F * kColumnWidth + 2.0F * kEdge;
constexpr float kKeysWidth = 124.0F;

std::string_view title_of(ActionGroup group) {
    switch (group) {
        case ActionGroup::playing:
            return "PLAYING";
        case ActionGroup::tempo:
            return "TEMPO";
        case ActionGroup::dance:
            return "DANCE";
        case ActionGroup::view:
            return "VIEW";
        case ActionGroup::window:
            break;
    }
    return "WINDOW";
}

/// Groups of the left column; the others are on the right.
constexpr bool is_left(ActionGroup group) {
    return group == ActionGroup::playing || group == ActionGroup::tempo;
}

/// A key as a small cap; returns its width.
float draw_cap(const Pen& pen, std::string_view name, float x, float y) {
    const ImFont* const font = pen.fonts().small;
    const float width = std::max(pen.width_of(font, name) + 14.0F, 22.0F);
    const Box cap{x, y, width, kCapHeight};
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

void draw_row(const Pen& pen, const ActionHelp& help, float x, float y) {
    float key_x = x;
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.action == help.action) {
            key_x += draw_cap(pen, binding.name, key_x, y) + 6.0F;
        }
    }
    const OverlayFonts& fonts = pen.fonts();
    pen.text(fonts.body,
             x + kKeysWidth,
             y + (kCapHeight - pen.height_of(fonts.body)) / 2.0F,
             palette::kText,
             help.text);
}

/// Draws (or, without a pen, measures) one column; returns where it ends.
float draw_column(const Pen* pen, bool (*takes)(ActionGroup), float x, float top) {
    float y = top;
    const ActionHelp* last = nullptr;
    for (const ActionHelp& help : action_help()) {
        if (!takes(help.group)) {
            continue;
        }
        if (last == nullptr || last->group != help.group) {
            y += last == nullptr ? 0.0F : kGroupGap;
            if (pen != nullptr) {
                pen->text(pen->fonts().small, x, y, palette::kAmber, title_of(help.group));
            }
            y += kTitleHeight - 8.0F;
        }
        if (pen != nullptr) {
            draw_row(*pen, help, x, y);
        }
        y += kRowHeight;
        last = &help;
    }
    return y;
}

constexpr bool is_right(ActionGroup group) { return !is_left(group); }

}  // namespace

bool has_room_beside_help(const Canvas& canvas) noexcept {
    return canvas.width >= kWidth + 2.0F * (kMargin + kCardWidth + kMargin / 2.0F);
}

void draw_help(const Pen& pen, const Canvas& canvas) {
    const float rows = std::max(draw_column(nullptr, is_left, 0.0F, 0.0F),
                                draw_column(nullptr, is_right, 0.0F, 0.0F));
    const float height = rows + 2.0F * kEdge + 38.0F;
    const Box box{(canvas.width - kWidth) / 2.0F, (canvas.height - height) / 2.0F, kWidth, height};
    pen.fill(box, {0x0C0E1A, 0.93F}, 12.0F);
    pen.outline(box, palette::kEdge, 12.0F);
    const float x = box.x + kEdge;
    float y = box.y + kEdge - 4.0F;
    pen.text(pen.fonts().bold, x, y, palette::kText, "Keys");
    pen.text(pen.fonts().small,
             box.right() - kEdge,
             y + 4.0F,
             palette::kDim,
             "drag: turn   wheel: zoom   right drag: move",
             Align::right);
    y += 38.0F;
    draw_column(&pen, is_left, x, y);
    draw_column(&pen, is_right, x + kColumnWidth, y);
}

}  // namespace raks::render
