#include "motion/capture/calibration/board_drawing.hpp"

#include <gtest/gtest.h>

#include <string>

#include "motion/capture/calibration/board_detection.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

TEST(BoardDrawing, is_found_where_it_was_painted) {
    const Board plain{.columns = 7, .rows = 6, .square = 0.04, .marker = 0.03};
    Board inverted = plain;
    inverted.is_inverted = true;
    const Board other{
        .columns = 5, .rows = 8, .square = 0.03, .marker = 0.015, .dictionary = "DICT_6X6_250"};
    const Board chessboard{.kind = BoardKind::chessboard, .columns = 8, .rows = 5, .square = 0.04};
    for (const Board& board : {plain, inverted, other, chessboard}) {
        constexpr int kPixels = 48;
        for (const bool has_caption : {false, true}) {
            const auto picture =
                has_caption ? draw_captioned_board(board, kPixels) : draw_board(board, kPixels);
            ASSERT_TRUE(picture) << picture.error().message;
            const BoardView view =
                find_board({picture->width, picture->height, picture->pixels}, board);
            ASSERT_EQ(view.corners.size(), corner_count(board)) << board_caption(board);
            EXPECT_FALSE(view.is_mirrored);
            EXPECT_EQ(view.is_inverted, board.is_inverted);
            for (const BoardCorner& corner : view.corners) {
                // Between the pixels of two squares.
                const glm::dvec2 expected =
                    corner_place(board, corner.corner) / board.square * double{kPixels} +
                    glm::dvec2(picture->margin - 0.5);
                EXPECT_LT(glm::distance(corner.pixel, expected), 0.05) << corner.corner;
            }
        }
    }
}

TEST(BoardDrawing, as_pdf_has_its_true_size) {
    const Board board{.columns = 4, .rows = 5, .square = 0.0254, .marker = 0.0127};
    const auto pdf = board_pdf(board);
    ASSERT_TRUE(pdf) << pdf.error().message;
    // 4 x 5 inches, 15 mm around, 20 mm for the caption.
    EXPECT_NE(pdf->find("/MediaBox [0 0 373.0394 501.7323]"), std::string::npos);
    EXPECT_NE(pdf->find(" 72.0000 72.0000 re f"), std::string::npos);
    EXPECT_NE(pdf->find("4 x 5 squares of 25.4 mm, markers of 12.7 mm, DICT_4X4_1000"),
              std::string::npos);
    EXPECT_TRUE(pdf->ends_with("%%EOF\n"));
    // The table of objects says where they begin.
    const std::size_t table = std::stoul(pdf->substr(pdf->find("startxref\n") + 10));
    EXPECT_EQ(pdf->substr(table, 4), "xref");
    EXPECT_EQ(pdf->substr(std::stoul(pdf->substr(table + 9 + 20, 10)), 7), "1 0 obj");
}

TEST(BoardDrawing, of_too_large_a_page_is_refused) {
    const Board board{.columns = 60, .rows = 9, .square = 0.1, .marker = 0.07};
    const auto pdf = board_pdf(board);
    ASSERT_FALSE(pdf);
    EXPECT_NE(pdf.error().message.find("PDF knows 5 m at most"), std::string::npos);
    EXPECT_FALSE(draw_board(board, 5));
    const Board many{.columns = 100, .rows = 20, .square = 0.1, .marker = 0.07};
    EXPECT_FALSE(draw_board(many, 400));
}

}  // namespace
}  // namespace raks::capture
