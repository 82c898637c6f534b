#include "motion/capture/calibration/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/suggest.hpp"

namespace raks::capture {

namespace {

constexpr int kFewestSquares = 3;
constexpr int kMostSquares = 100;
constexpr double kSmallest = 0.001;  // metres
constexpr double kLargest = 2.0;     // metres
constexpr double kNarrowestMargin = 0.05;

std::size_t count(int squares) noexcept { return static_cast<std::size_t>(std::max(squares, 1)); }

Expected<void> check_markers(const Board& board) {
    const std::size_t has = marker_count(board.dictionary);
    if (has == 0) {
        const std::vector<std::string_view> names = dictionary_names();
        return fail(unknown_name("dictionary", board.dictionary, names));
    }
    const std::size_t needs = count(board.columns) * count(board.rows) / 2;
    if (needs > has) {
        return fail(fmt::format("a board of {} x {} squares has {} markers, {} has {} only",
                                board.columns,
                                board.rows,
                                needs,
                                board.dictionary,
                                has));
    }
    if (!(board.marker >= kSmallest && board.marker <= board.square * (1.0 - kNarrowestMargin))) {
        return fail(
            fmt::format("the marker's side is {} mm, must be 1 mm to {} mm, 95 % of a square",
                        board.marker * 1e3,
                        board.square * (1.0 - kNarrowestMargin) * 1e3));
    }
    return {};
}

}  // namespace

Expected<void> check_board(const Board& board) {
    for (const auto& [name, squares] :
         {std::pair("columns", board.columns), std::pair("rows", board.rows)}) {
        if (squares < kFewestSquares || squares > kMostSquares) {
            return fail(fmt::format("the board has {} {}, must be {} to {}",
                                    squares,
                                    name,
                                    kFewestSquares,
                                    kMostSquares));
        }
    }
    if (!(board.square >= kSmallest && board.square <= kLargest)) {
        return fail(fmt::format("the side of a square is {} m, must be {} to {} (metres)",
                                board.square,
                                kSmallest,
                                kLargest));
    }
    if (board.kind == BoardKind::charuco) {
        return check_markers(board);
    }
    if ((board.columns + board.rows) % 2 == 0) {
        return fail(fmt::format(
            "a chessboard of {} x {} squares looks the same upside down: one number must be even "
            "and one odd",
            board.columns,
            board.rows));
    }
    return {};
}

std::size_t corner_count(const Board& board) noexcept {
    return (count(board.columns) - 1) * (count(board.rows) - 1);
}

glm::dvec2 corner_place(const Board& board, std::size_t corner) noexcept {
    const std::size_t across = std::max<std::size_t>(count(board.columns), 2) - 1;
    const std::size_t row = corner / across;
    return {board.square * static_cast<double>(corner - row * across + 1),
            board.square * static_cast<double>(row + 1)};
}

std::vector<std::pair<std::size_t, std::size_t>> board_edges(const Board& board) {
    const std::size_t across = count(board.columns) - 1;
    const std::size_t corners = corner_count(board);
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t i = 0; i < corners; ++i) {
        if ((i + 1) % across != 0) {
            edges.emplace_back(i, i + 1);
        }
        if (i + across < corners) {
            edges.emplace_back(i, i + across);
        }
    }
    return edges;
}

}  // namespace raks::capture
