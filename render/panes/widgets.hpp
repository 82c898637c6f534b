// Widgets: the few things that panes are made of. All stand where they are told, so that a layout
// is known without drawing.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "render/panes/pane_context.hpp"

namespace raks::render {

/// Colours of panes, beside those of `palette`.
namespace pane_colours {
inline constexpr Colour kGround{0x12141F};       ///< behind everything
inline constexpr Colour kSunken{0x0A0B12};       ///< behind pictures and curves
inline constexpr Colour kRaised{0x20243A};       ///< buttons, rows under the pointer
inline constexpr Colour kChosen{0x2F4A63};       ///< what is chosen
inline constexpr Colour kLine{0xFFFFFF, 0.12F};  ///< between parts
}  // namespace pane_colours

/// What the pointer does with an item.
struct PaneItem {
    bool is_hovered = false;  ///< lies over it
    bool is_clicked = false;  ///< the left button was pressed and let go over it; in this frame
};

/// A rectangle that can be clicked; drawn by the caller. `name` is its own in the frame.
[[nodiscard]] PaneItem pane_item(const Box& box, std::string_view name, const PaneFrame& frame);

/// How a button looks.
enum class ButtonLook : std::uint8_t {
    usual,   ///< may be clicked
    chosen,  ///< is on, or the place where one is
    off      ///< cannot be used now, and is not clicked
};

/// A button with a word on it, cut where it is too long. True: it was clicked.
[[nodiscard]] bool pane_button(const PaneFrame& frame,
                               const Box& box,
                               std::string_view label,
                               ButtonLook look = ButtonLook::usual);

/// A row of a list: a round swatch, a name, and a short note at its right end.
struct PaneRow {
    std::string_view name;         ///< also the item's name: its own in the frame
    std::string_view note;         ///< cut where the name leaves it no room; may be empty
    Colour swatch;                 ///< of the colour that it stands for
    Colour text = palette::kText;  ///< of its name
    bool is_chosen = false;        ///< highlighted
    bool is_ticked = false;        ///< the swatch is full, else a ring
};
/// Draws it. True: it was clicked.
[[nodiscard]] bool pane_row(const PaneFrame& frame, const Box& box, const PaneRow& row);

/// A number that is pulled from `low` to `high`.
struct PaneSlider {
    std::string_view name;   ///< on its left; also the item's name: its own in the frame
    std::string_view value;  ///< in words, at its right end
    float at = 0.0F;
    float low = 0.0F;
    float high = 1.0F;  ///< above `low`
};
/// Draws it. Result: where it was pulled or clicked to.
[[nodiscard]] std::optional<float> pane_slider(const PaneFrame& frame,
                                               const Box& box,
                                               const PaneSlider& slider);

/// The colour of a name that people give to paints ("green", "cyan"); another one for each name
/// that is none, always the same.
[[nodiscard]] Colour named_colour(std::string_view name) noexcept;

}  // namespace raks::render
