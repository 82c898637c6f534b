// Finding a board in a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motion/capture/calibration/board.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// A picture in shades of grey: width * height bytes, row by row from the top.
struct GreyPicture {
    int width = 0;
    int height = 0;
    std::span<const std::uint8_t> pixels;
};

/// An inner corner of the board and where it was seen.
struct BoardCorner {
    std::size_t corner = 0;  ///< as corner_place counts
    glm::dvec2 pixel{};      ///< whole numbers are pixels' centres

    friend bool operator==(const BoardCorner&, const BoardCorner&) = default;
};

/// Fewer corners do not tell where a board is.
inline constexpr std::size_t kFewestBoardCorners = 4;

/// What was found of a board in one picture.
struct BoardView {
    std::vector<BoardCorner> corners;  ///< in no order
    bool is_mirrored = false;          ///< seen from behind; the pixels are those of the picture
    bool is_inverted = false;          ///< its black is white, or else than the board says
    std::size_t foreign_markers = 0;   ///< of its dictionary, but not of this board

    /// Whether any corner was found. Fewer than kFewestBoardCorners may be there by chance.
    [[nodiscard]] bool is_found() const noexcept { return !corners.empty(); }
};

/// How corners are refined to a fraction of a pixel.
enum class CornerWindow : std::uint8_t {
    adaptive,  ///< within the squares and clear of markers, down to 0.01 px: the default
    classic    ///< 11 px to each side, down to 0.1 px, as OpenCV's sample: spans small squares
};

/// Finds a board, also inverted, seen from behind or (ChArUco) in part; corners that do not lie on
/// a plane with the others are dropped. A chessboard seen from behind looks as from the front, and
/// is taken for that: use ChArUco where the board may be seen from both sides. `board` passed
/// check_board. A picture without size, or whose bytes are fewer than its size says, has no board.
/// Threads: any. Real-time: no (some 20 ms for 1280 x 720 pixels, four times that without a board).
[[nodiscard]] BoardView find_board(const GreyPicture& picture,
                                   const Board& board,
                                   CornerWindow window = CornerWindow::adaptive);

/// The dictionary that most of a picture's markers are of, by its name; empty: there are fewer than
/// four, or it is seen from behind. For a message to who named the wrong one. Takes a second.
[[nodiscard]] std::string_view guess_dictionary(const GreyPicture& picture);

}  // namespace raks::capture
