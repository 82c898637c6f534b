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
    std::uint32_t rgb = 0;
    float alpha = 1.0F;
    [[nodiscard]] constexpr Colour faded(float factor) const noexcept {
        return {rgb, alpha * factor};
    }
};

/// Colours of the stage theme: its amber rings, the teal of the stick figure, its night blue.
namespace palette {
inline constexpr Colour kPanel{0x0C0E1A, 0.66F};
inline constexpr Colour kEdge{0xFFFFFF, 0.07F};
inline constexpr Colour kTrough{0xFFFFFF, 0.10F};
inline constexpr Colour kText{0xF2EEE6};
inline constexpr Colour kDim{0xA4A9C2};
inline constexpr Colour kAmber{0xFFB454};
inline constexpr Colour kTeal{0x62D0C8};
inline constexpr Colour kRed{0xF2555A};
}  // namespace palette

struct Box {
    float x = 0.0F;
    float y = 0.0F;
    float width = 0.0F;
    float height = 0.0F;
    [[nodiscard]] constexpr float right() const noexcept { return x + width; }
    [[nodiscard]] constexpr float bottom() const noexcept { return y + height; }
    [[nodiscard]] constexpr Box inside(float margin) const noexcept {
        return {x + margin, y + margin, width - 2.0F * margin, height - 2.0F * margin};
    }
};

enum class Align { left, right, middle };

/// Draws the overlay's few shapes in units of 1/720 of an ordinary picture's height; y down.
class Pen {
 public:
    /// `unit`: pixels a unit; `origin`: pixel of (0, 0).
    Pen(ImDrawList& list, const OverlayFonts& fonts, float unit, ImVec2 origin) noexcept
        : list_(list), fonts_(fonts), unit_(unit), origin_(origin) {}

    [[nodiscard]] const OverlayFonts& fonts() const noexcept { return fonts_; }

    /// A translucent card with a fine edge.
    void panel(const Box& box) const;
    void fill(const Box& box, Colour colour, float radius = 0.0F) const;
    void outline(const Box& box, Colour colour, float radius) const;
    /// A round trough of which `fraction` is full.
    void bar(const Box& box, float fraction, Colour colour) const;
    void dot(float x, float y, float radius, Colour colour) const;
    void ring(float x, float y, float radius, Colour colour) const;
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
    [[nodiscard]] float width_of(const ImFont* font, std::string_view line) const;
    [[nodiscard]] float height_of(const ImFont* font) const { return font->FontSize / unit_; }

 private:
    [[nodiscard]] ImVec2 at(float x, float y) const noexcept;

    ImDrawList& list_;
    const OverlayFonts& fonts_;
    float unit_;
    ImVec2 origin_;
};

}  // namespace raks::render
