#include "render/overlay/pen.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/overlay/text_format.hpp"

namespace raks::render {
namespace {

constexpr float kPanelRadius = 10.0F;
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

/// ImGui's colour: red in the lowest byte.
ImU32 packed(Colour colour) {
    const auto alpha =
        static_cast<ImU32>(std::lround(std::clamp(colour.alpha, 0.0F, 1.0F) * 255.0F));
    const ImU32 red = (colour.rgb >> 16U) & 0xFFU;
    const ImU32 green = (colour.rgb >> 8U) & 0xFFU;
    const ImU32 blue = colour.rgb & 0xFFU;
    return red | green << 8U | blue << 16U | alpha << 24U;
}

/// ImGui takes text as two pointers.
const char* end_of(std::string_view text) { return text.data() + text.size(); }

}  // namespace

/// Units to pixels.
ImVec2 Pen::at(float x, float y) const noexcept {
    return {origin_.x + x * unit_, origin_.y + y * unit_};
}

void Pen::panel(const Box& box) const {
    fill(box, palette::kPanel, kPanelRadius);
    outline(box, palette::kEdge, kPanelRadius);
}

void Pen::fill(const Box& box, Colour colour, float radius) const {
    // On whole pixels, so that fine bars are as thick everywhere.
    const ImVec2 low = at(box.x, box.y);
    const ImVec2 high = at(box.right(), box.bottom());
    const ImVec2 from{std::round(low.x), std::round(low.y)};
    const ImVec2 to{std::max(std::round(high.x), from.x + 1.0F),
                    std::max(std::round(high.y), from.y + 1.0F)};
    list_.AddRectFilled(from, to, packed(colour), radius * unit_);
}

void Pen::outline(const Box& box, Colour colour, float radius) const {
    list_.AddRect(at(box.x, box.y),
                  at(box.right(), box.bottom()),
                  packed(colour),
                  radius * unit_,
                  ImDrawFlags_None,
                  std::max(1.0F, unit_));
}

void Pen::bar(const Box& box, float fraction, Colour colour) const {
    const float radius = box.height / 2.0F;
    fill(box, palette::kTrough, radius);
    const float full = std::isnan(fraction) ? 0.0F : std::clamp(fraction, 0.0F, 1.0F) * box.width;
    if (full > 0.0F) {
        // Never shorter than it is high, or its round ends would not fit.
        fill({box.x, box.y, std::max(full, box.height), box.height}, colour, radius);
    }
}

void Pen::dot(float x, float y, float radius, Colour colour) const {
    list_.AddCircleFilled(at(x, y), radius * unit_, packed(colour));
}

void Pen::ring(float x, float y, float radius, Colour colour) const {
    list_.AddCircle(at(x, y), radius * unit_, packed(colour), 0, std::max(1.0F, 1.5F * unit_));
}

void Pen::line(
    float from_x, float from_y, float to_x, float to_y, Colour colour, float width) const {
    list_.AddLine(
        at(from_x, from_y), at(to_x, to_y), packed(colour), std::max(1.0F, width * unit_));
}

void Pen::triangle(ImVec2 a, ImVec2 b, ImVec2 c, Colour colour) const {
    list_.AddTriangleFilled(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y), packed(colour));
}

float Pen::width_of(const ImFont* font, std::string_view line) const {
    return font->CalcTextSizeA(font->FontSize, 1e9F, 0.0F, line.data(), end_of(line)).x / unit_;
}

float Pen::text(const ImFont* font,
                float x,
                float y,
                Colour colour,
                std::string_view line,
                Align align,
                float max_width) const {
    // Names of files and devices may hold line breaks, which ImGui would obey.
    std::string shown = one_line(line);
    float width = width_of(font, shown);
    if (width > max_width) {
        // The ellipsis must fit, too.
        const float room = std::max(max_width - width_of(font, kEllipsis), 0.0F);
        const char* cut = nullptr;  // first character that does not fit
        font->CalcTextSizeA(font->FontSize, room * unit_, 0.0F, shown.data(), end_of(shown), &cut);
        shown.resize(static_cast<std::size_t>(cut - shown.data()));
        shown += kEllipsis;
        width = width_of(font, shown);
    }
    // How far left of `x` the text starts.
    const float shift = align == Align::left ? 0.0F : align == Align::right ? width : width / 2.0F;
    const ImVec2 place = at(x - shift, y);
    // On whole pixels: the glyphs were rasterized for them.
    list_.AddText(font,
                  font->FontSize,
                  {std::round(place.x), std::round(place.y)},
                  packed(colour),
                  shown.data(),
                  end_of(shown));
    return width;
}

}  // namespace raks::render
