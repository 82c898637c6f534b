#include "motion/capture/calibration/board.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

TEST(Board, has_its_inner_corners_row_by_row_and_edges_as_long_as_a_square) {
    const Board board{.columns = 4, .rows = 5, .square = 0.054, .marker = 0.0405};
    ASSERT_TRUE(check_board(board));
    EXPECT_EQ(corner_count(board), 12U);
    EXPECT_EQ(corner_place(board, 0), glm::dvec2(0.054, 0.054));
    EXPECT_NEAR(glm::distance(corner_place(board, 11), {3 * 0.054, 4 * 0.054}), 0.0, 1e-15);
    const auto edges = board_edges(board);
    EXPECT_EQ(edges.size(), 2U * 4U + 3U * 3U);
    for (const auto& [from, to] : edges) {
        EXPECT_NEAR(
            glm::distance(corner_place(board, from), corner_place(board, to)), 0.054, 1e-12);
    }
}

TEST(Board, is_refused_with_what_is_wrong) {
    const std::vector<std::pair<std::function<void(Board&)>, std::string>> faults = {
        {[](Board& b) { b.columns = 2; }, "2 columns, must be 3 to 100"},
        {[](Board& b) { b.rows = 1'000'000; }, "1000000 rows, must be 3 to 100"},
        {[](Board& b) { b.square = 80.0; }, "80 m, must be 0.001 to 2 (metres)"},
        {[](Board& b) { b.marker = b.square; }, "95 % of a square"},
        {[](Board& b) { b.dictionary = "DICT_4X4_10000"; }, "did you mean \"DICT_4X4_1000\"?"},
        {[](Board& b) {
             b.dictionary = "DICT_4X4_50";
             b.columns = 11;
             b.rows = 10;
         },
         "has 55 markers, DICT_4X4_50 has 50 only"},
        {[](Board& b) { b.kind = BoardKind::chessboard; }, "looks the same upside down"},
    };
    ASSERT_TRUE(check_board({}));
    for (const auto& [spoil, expected] : faults) {
        Board board;
        spoil(board);
        const Expected<void> checked = check_board(board);
        ASSERT_FALSE(checked) << expected;
        EXPECT_NE(checked.error().message.find(expected), std::string::npos)
            << checked.error().message;
    }
}

TEST(Board, has_markers_with_a_black_border_and_no_two_alike) {
    for (const std::string_view dictionary : dictionary_names()) {
        ASSERT_GT(marker_count(dictionary), 29U) << dictionary;
        const MarkerCells first = marker_cells(dictionary, 0);
        const MarkerCells second = marker_cells(dictionary, 1);
        EXPECT_NE(first.is_white, second.is_white);
        for (int i = 0; i < first.side; ++i) {
            EXPECT_FALSE(first.is_white[static_cast<std::size_t>(i)]);
            EXPECT_FALSE(first.is_white[static_cast<std::size_t>(i * first.side)]);
        }
    }
    EXPECT_EQ(marker_count("DICT_9X9_1"), 0U);
}

}  // namespace
}  // namespace raks::capture
