// The board to print.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// A rectangle of a board, in the board's axes; metres.
struct BoardPatch {
    glm::dvec2 corner{};  ///< top left
    glm::dvec2 size{};
    bool is_black = true;
};

/// What a board is painted of, in order: later patches cover earlier ones. The first is the whole
/// board. `board` passed check_board.
[[nodiscard]] std::vector<BoardPatch> board_patches(const Board& board);

/// What is printed beside a board: "8 x 6 squares of 80 mm, markers of 60 mm, DICT_4X4_1000".
[[nodiscard]] std::string board_caption(const Board& board);

/// A page with the board in its true size, its caption, and a line of 100 mm to measure the print
/// by: PDF, of rectangles, so that it is sharp in any size. Error: a page of more than 5 m, which
/// PDF does not know.
[[nodiscard]] Expected<std::string> board_pdf(const Board& board);

/// A board in shades of grey.
struct BoardPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;  ///< width * height, row by row from the top
    int margin = 0;                    ///< around the board: half a square; pixels
};

/// Paints a board with so many pixels a square (10 to 400), without its caption. Error: a picture
/// of more than 100 megapixels.
[[nodiscard]] Expected<BoardPicture> draw_board(const Board& board, int pixels_per_square);

/// The same with a margin of a square and the caption under the board, to be printed so that a
/// square has its size.
[[nodiscard]] Expected<BoardPicture> draw_captioned_board(const Board& board,
                                                          int pixels_per_square);

}  // namespace raks::capture
