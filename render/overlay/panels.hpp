#pragma once

#include <span>

#include "render/overlay/overlay.hpp"
#include "render/overlay/pen.hpp"

/// The parts of the overlay, each drawn into a picture of width x height units. Every number of the
/// state is in its documented range here.
namespace raks::render {

/// Size of the picture in the pen's units.
struct Canvas {
    /// Units, not pixels.
    float width = 1280.0F;
    /// As width.
    float height = 720.0F;
};

/// The cards stand in the corners and leave the middle, and the feet, to the dancer.
inline constexpr float kMargin = 24.0F;      ///< between a card and the picture's edge
inline constexpr float kInner = 18.0F;       ///< between a card's edge and its text
inline constexpr float kCardWidth = 214.0F;  ///< all but the source's
/// Height of the cards at the top.
inline constexpr float kTopHeight = 138.0F;
/// Height of the cards at the bottom.
inline constexpr float kBottomHeight = 76.0F;

/// Whether cards fit side by side; else those on the right are left out.
[[nodiscard]] constexpr bool has_two_columns(const Canvas& canvas) noexcept {
    return canvas.width >= 2.0F * (kMargin + kCardWidth) + kMargin;
}

/// Whether there is room for the cards at the bottom.
[[nodiscard]] constexpr bool has_two_rows(const Canvas& canvas) noexcept {
    return canvas.height >= kTopHeight + kBottomHeight + 3.0F * kMargin;
}

/// Whether the cards leave the middle to the dancer; else they would cover one in a small picture.
[[nodiscard]] constexpr bool has_room_for_cards(const Canvas& canvas) noexcept {
    return kMargin + kCardWidth <= 0.38F * canvas.width ||
           kMargin + kTopHeight <= 0.22F * canvas.height;
}

/// The sign that a click uses: two bars while it plays (a click pauses), a triangle while it stands
/// (a click plays). `x`, `y`: its middle.
void draw_play_sign(const Pen& pen, bool is_paused, float x, float y);
/// Top left of a small picture: the tempo in one line.
void draw_small_tempo(const Pen& pen, const OverlayState& state);
/// Top left: tempo, what is known of it, the dots of the bar.
void draw_tempo(const Pen& pen, const OverlayState& state);
/// Top right: genre and figure; below it the line of health.
void draw_dance(const Pen& pen, const OverlayState& state, const Canvas& canvas);
/// Bottom left: source and position, above them who else is told. Returns where they can be
/// clicked.
OverlayControls draw_source(const Pen& pen, const OverlayState& state, const Canvas& canvas);
/// Bottom right: level, loudness, volume.
void draw_level(const Pen& pen, const OverlayState& state, const Canvas& canvas);
/// Lines and names over the picture.
void draw_marks(const Pen& pen, const OverlayState& state);
/// Along the lower edge: which frame of a clip is shown. Returns where it can be clicked.
OverlayControls draw_transport(const Pen& pen,
                               const OverlayTransport& transport,
                               const Canvas& canvas);
/// Above the source: one line that comes and goes.
void draw_message(const Pen& pen, const OverlayState& state, const Canvas& canvas);
/// Middle: one page of the list of keys, in two columns that break between groups, or in one where
/// the picture is narrow; over several pages where the picture is low. `page` counts on from the
/// first behind the last. Adds where each key can be clicked, and how many pages there are.
void draw_help(const Pen& pen,
               std::span<const HelpRow> rows,
               std::size_t page,
               const Canvas& canvas,
               OverlayControls& controls);
/// Middle: a list, scrolled to the row that is chosen. Adds where rows and pages can be clicked.
void draw_list(const Pen& pen,
               const OverlayList& list,
               const Canvas& canvas,
               OverlayControls& controls);
/// At the right, half way down: a code with its line. One that is not as many modules as it says is
/// left out.
void draw_code(const Pen& pen, const OverlayCode& code, const Canvas& canvas);
/// Whether the cards stay visible beside a panel of this width in the middle.
[[nodiscard]] bool has_room_beside(float width, const Canvas& canvas) noexcept;
/// Width of the list of keys where it has two columns, and of a list.
inline constexpr float kKeysPanelWidth = 744.0F;
inline constexpr float kListPanelWidth = 520.0F;  ///< likewise

/// What a box of the pen covers, in pixels of the target.
[[nodiscard]] OverlayControls::Area area_of(const Pen& pen, const Box& box) noexcept;

}  // namespace raks::render
