// Board: the flat pattern that is shown to the cameras, and where its corners lie on it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// What is printed on a board.
enum class BoardKind {
    charuco,    ///< a chessboard with an ArUco marker in each white square: part of it is enough
    chessboard  ///< must be seen whole; one of its sides has an even number of inner corners and
                ///< the other an odd one, else it looks the same upside down
};

/// A board, as it is printed. Its own axes: x along a row, y down the columns, z away from who
/// looks at it; the origin is the top left corner of the outer squares. Metres.
struct Board {
    BoardKind kind = BoardKind::charuco;
    int columns = 8;                           ///< squares along x; 3 to 100
    int rows = 6;                              ///< squares along y; 3 to 100
    double square = 0.08;                      ///< side of a square; metres
    double marker = 0.06;                      ///< side of a marker, less than a square; metres
    std::string dictionary = "DICT_4X4_1000";  ///< of its markers, by OpenCV's name
    bool is_inverted = false;                  ///< black and white are exchanged

    friend bool operator==(const Board&, const Board&) = default;
};

/// Checks a board: columns and rows, sizes above 1 mm and below 2 m, a marker that leaves a margin
/// of at least a twentieth of its square, a known dictionary with enough markers; of a chessboard,
/// that it does not look the same upside down.
[[nodiscard]] Expected<void> check_board(const Board& board);

/// How many inner corners it has: (columns - 1) (rows - 1).
[[nodiscard]] std::size_t corner_count(const Board& board) noexcept;

/// Where an inner corner lies, counted along the rows from the top left one; metres.
[[nodiscard]] glm::dvec2 corner_place(const Board& board, std::size_t corner) noexcept;

/// The edges between neighbouring inner corners, as pairs of corners; all as long as a square.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> board_edges(const Board& board);

/// Names of the dictionaries.
[[nodiscard]] std::vector<std::string_view> dictionary_names();

/// The black and white cells of a marker with its black border, row by row; true: white.
struct MarkerCells {
    int side = 0;                ///< cells along a side, border included
    std::vector<bool> is_white;  ///< side * side
};

/// How many markers a dictionary has; 0: there is none of this name.
[[nodiscard]] std::size_t marker_count(std::string_view dictionary);

/// A marker of a known dictionary; `marker` is below its count.
[[nodiscard]] MarkerCells marker_cells(std::string_view dictionary, std::size_t marker);

}  // namespace raks::capture
