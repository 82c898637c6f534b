#include "render/overlay/picture_text.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/utf8.hpp"
#include "render/overlay/fonts.hpp"

namespace raks::render {
namespace {

/// Takes the character at the start of a text; what is no UTF-8 is a question mark.
char32_t take_character(std::string_view& text) {
    const std::size_t size = utf8_size(text);
    if (size == 0) {
        text.remove_prefix(1);
        return U'?';
    }
    // Bits of the first byte that belong to the character: 7, 5, 4 or 3.
    const auto first = static_cast<unsigned char>(text[0]);
    char32_t character = size == 1 ? first : first & (0xFFU >> (size + 1));
    for (const char byte : text.substr(1, size - 1)) {
        character = character << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
    }
    text.remove_prefix(size);
    return character;
}

void blend(std::uint8_t& to, std::uint32_t colour, unsigned coverage) {
    to = static_cast<std::uint8_t>((to * (255U - coverage) + colour * coverage + 127U) / 255U);
}

}  // namespace

struct PictureText::Font {
    ImFontAtlas atlas;
    const ImFont* face = nullptr;
    // One byte of coverage a pixel.
    const unsigned char* coverage = nullptr;
    int width = 0;
    int height = 0;

    [[nodiscard]] const ImFontGlyph& glyph(char32_t character) const {
        const bool is_small = character <= IM_UNICODE_CODEPOINT_MAX;
        return *face->FindGlyph(static_cast<ImWchar>(is_small ? character : U'?'));
    }
    void draw(const Picture& picture,
              const ImFontGlyph& glyph,
              float x,
              float y,
              std::uint32_t rgb) const;
};

PictureText::PictureText(float pixels) : font_(std::make_unique<Font>()) {
    font_->face = add_font(font_->atlas, FontFace::plain, pixels, Glyphs::names, 1);
    unsigned char* coverage = nullptr;
    font_->atlas.GetTexDataAsAlpha8(&coverage, &font_->width, &font_->height);
    font_->coverage = coverage;
}

PictureText::PictureText(PictureText&&) noexcept = default;
PictureText& PictureText::operator=(PictureText&&) noexcept = default;
PictureText::~PictureText() = default;

/// One glyph, on whole pixels.
void PictureText::Font::draw(
    const Picture& picture, const ImFontGlyph& glyph, float x, float y, std::uint32_t rgb) const {
    const int from_x = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(width)));
    const int from_y = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(height)));
    const int columns =
        static_cast<int>(std::lround(glyph.U1 * static_cast<float>(width))) - from_x;
    const int rows = static_cast<int>(std::lround(glyph.V1 * static_cast<float>(height))) - from_y;
    const int left = static_cast<int>(std::lround(x + glyph.X0));
    const int top = static_cast<int>(std::lround(y + glyph.Y0));
    for (int row = std::max(0, -top); row < std::min(rows, picture.height - top); ++row) {
        for (int column = std::max(0, -left); column < std::min(columns, picture.width - left);
             ++column) {
            const unsigned alpha = coverage[(from_y + row) * width + from_x + column];
            const auto pixel =
                static_cast<std::size_t>(top + row) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(left + column);
            blend(picture.rgba[4 * pixel], rgb >> 16U & 0xFFU, alpha);
            blend(picture.rgba[4 * pixel + 1], rgb >> 8U & 0xFFU, alpha);
            blend(picture.rgba[4 * pixel + 2], rgb & 0xFFU, alpha);
        }
    }
}

void PictureText::write(
    const Picture& picture, int x, int y, std::uint32_t rgb, std::string_view line) const {
    auto at = static_cast<float>(x);
    while (!line.empty() && at < static_cast<float>(picture.width)) {
        const ImFontGlyph& glyph = font_->glyph(take_character(line));
        if (glyph.Visible != 0) {
            font_->draw(picture, glyph, at, static_cast<float>(y), rgb);
        }
        at += glyph.AdvanceX;
    }
}

float PictureText::width_of(std::string_view line) const {
    float width = 0.0F;
    while (!line.empty()) {
        width += font_->glyph(take_character(line)).AdvanceX;
    }
    return width;
}

}  // namespace raks::render
