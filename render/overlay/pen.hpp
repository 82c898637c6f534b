#pragma once

#include <imgui.h>

#include <cstdint>
#include <string_view>

namespace raks::render {

/// Fonts of one scale.
struct OverlayFonts {
    ImFont* small = nullptr;  ///< 12 units: labels
    ImFont* body = nullptr;   ///< 15 units
    ImFont* bold = nullptr;   ///< 17 units: names
    ImFont* large = nullptr;  ///< 46 units: the tempo
};

/// sRGB colour 0xRRGGBB with opacity [0, 1].
struct Colour {
    /// 0xRRGGBB.
    std::uint32_t rgb = 0;
    /// 0 is invisible.
    float alpha = 1.0F;
    /// The same colour with `factor` of its opacity.
    [[nodiscard]] constexpr Colour faded(float factor) const noexcept {
        return {rgb, alpha * factor};
    }
};

/// Colours of the stage theme: its amber rings, the teal of the stick figure, its night blue.
namespace palette {
inline constexpr Colour kPanel{0x0C0E1A, 0.66F};   ///< ground of a card
inline constexpr Colour kEdge{0xFFFFFF, 0.07F};    ///< outline of a card
inline constexpr Colour kTrough{0xFFFFFF, 0.10F};  ///< unfilled part of a bar or meter
inline constexpr Colour kText{0xF2EEE6};           ///< values
inline constexpr Colour kDim{0xA4A9C2};            ///< labels, and values that are not sure
inline constexpr Colour kAmber{0xFFB454};          ///< downbeat, counts, warnings
inline constexpr Colour kTeal{0x62D0C8};           ///< beats, levels, confidence
inline constexpr Colour kRed{0xF2555A};            ///< close to clipping; live input
}  // namespace palette

/// A rectangle in the pen's units; y down.
struct Box {
    /// Left edge.
    float x = 0.0F;
    /// Upper edge.
    float y = 0.0F;
    /// To the right.
    float width = 0.0F;
    /// Downward.
    float height = 0.0F;
    /// Right edge.
    [[nodiscard]] constexpr float right() const noexcept { return x + width; }
    /// Lower edge.
    [[nodiscard]] constexpr float bottom() const noexcept { return y + height; }
    /// The box without `margin` on every side.
    [[nodiscard]] constexpr Box inside(float margin) const noexcept {
        return {x + margin, y + margin, width - 2.0F * margin, height - 2.0F * margin};
    }
};

/// What the x of a text is: its left end, right end or middle.
enum class Align { left, right, middle };

/// Draws the overlay's few shapes in units of 1/720 of an ordinary picture's height; y down.
class Pen {
 public:
    /// `unit`: pixels a unit; `origin`: pixel of (0, 0).
    Pen(ImDrawList& list, const OverlayFonts& fonts, float unit, ImVec2 origin) noexcept
        : list_(list), fonts_(fonts), unit_(unit), origin_(origin) {}

    /// The fonts of this pen's scale.
    [[nodiscard]] const OverlayFonts& fonts() const noexcept { return fonts_; }

    /// A translucent card with a fine edge.
    void panel(const Box& box) const;
    /// A filled rectangle with rounded corners, on whole pixels and at least one pixel thick.
    void fill(const Box& box, Colour colour, float radius = 0.0F) const;
    /// Its edge, one unit wide and at least one pixel.
    void outline(const Box& box, Colour colour, float radius) const;
    /// A round trough of which `fraction` is full.
    void bar(const Box& box, float fraction, Colour colour) const;
    /// A filled circle about (x, y).
    void dot(float x, float y, float radius, Colour colour) const;
    /// The edge of a circle.
    void ring(float x, float y, float radius, Colour colour) const;
    /// A straight line, `width` units wide and at least one pixel.
    void line(float from_x, float from_y, float to_x, float to_y, Colour colour, float width = 1.0F)
        const;
    /// A filled triangle, in units.
    void triangle(ImVec2 a, ImVec2 b, ImVec2 c, Colour colour) const;
    /// One line; `x` is where it starts, ends or has its middle; `y` its top. Cut with an ellipsis
    /// where it is wider than `max_width`. Returns its width.
    float text(const ImFont* font,
               float x,
               float y,
               Colour colour,
               std::string_view line,
               Align align = Align::left,
               float max_width = 1e6F) const;
    /// Width of a line, units.
    [[nodiscard]] float width_of(const ImFont* font, std::string_view line) const;
    /// Pixels a unit.
    [[nodiscard]] float unit() const noexcept { return unit_; }
    /// Height of a line, units.
    [[nodiscard]] float height_of(const ImFont* font) const { return font->FontSize / unit_; }

 private:
    [[nodiscard]] ImVec2 at(float x, float y) const noexcept;

    ImDrawList& list_;
    const OverlayFonts& fonts_;
    float unit_;
    ImVec2 origin_;
};

}  // namespace raks::render
