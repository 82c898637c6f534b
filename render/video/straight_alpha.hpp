#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace raks::render {

/// Pictures are drawn with premultiplied colours: each is multiplied by its alpha already. Files
/// have them straight. Divides the colours of `rgba` by their alpha, in place; where alpha is 0
/// they become 0. Threads: any.
void make_straight(std::span<std::uint8_t> rgba) noexcept;

/// The same for films, whose codecs mix the colours of neighbours: a pixel that is hardly covered
/// or not at all gets the colour of what is near, so that no dark rim comes into the edges. Alpha
/// is unchanged, and so is every pixel that is covered by an eighth or more.
///
/// Colours are averaged, weighted by alpha, in squares of 2, 4, 8 .. pixels; a pixel takes that of
/// the smallest square around it that holds any.
/// Threads: one. Real-time: no.
class EdgeColours {
 public:
    /// Sides in pixels, > 0.
    EdgeColours(int width, int height);

    /// `rgba`: premultiplied, width x height x 4 bytes, top row first; becomes straight.
    void make_straight(std::span<std::uint8_t> rgba);

 private:
    // Sums over a square: of premultiplied colours and of alpha.
    struct Square {
        float red = 0.0F;
        float green = 0.0F;
        float blue = 0.0F;
        float alpha = 0.0F;
    };
    struct Level {
        std::size_t width = 0;
        std::size_t height = 0;
        std::vector<Square> squares;
    };

    void sum_up(std::span<const std::uint8_t> rgba);
    void hand_down();

    std::size_t width_;
    std::size_t height_;
    std::vector<Level> levels_;  // from squares of 2 pixels to one that holds all
};

}  // namespace raks::render
