#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace raks::render {

/// Writes lines into a picture in memory: labels of sheets. Needs no OpenGL. The same line gives
/// the same pixels. Threads: one. Real-time: no.
class PictureText {
 public:
    /// A picture: RGBA, four bytes a pixel, the top row first.
    struct Picture {
        std::span<std::uint8_t> rgba;  ///< width * height * 4 bytes
        int width = 0;                 ///< pixels
        int height = 0;                ///< pixels
    };

    /// `pixels`: height of a line, > 0.
    explicit PictureText(float pixels);
    /// The source may only be destroyed or assigned to.
    PictureText(PictureText&&) noexcept;
    PictureText& operator=(PictureText&&) noexcept;  ///< as the constructor
    ~PictureText();                                  ///< frees the font

    /// Writes UTF-8 from its upper left corner (x, y) on, in a colour 0xRRGGBB; what lies outside
    /// of the picture is left out.
    void write(
        const Picture& picture, int x, int y, std::uint32_t rgb, std::string_view line) const;
    /// Pixels that a line takes.
    [[nodiscard]] float width_of(std::string_view line) const;

 private:
    struct Font;
    std::unique_ptr<Font> font_;
};

}  // namespace raks::render
