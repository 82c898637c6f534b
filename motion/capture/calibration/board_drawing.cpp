#include "motion/capture/calibration/board_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raks::capture {

namespace {

constexpr double kPointsPerMetre = 72.0 / 0.0254;
constexpr double kMargin = 0.015;          // metres
constexpr double kCaption = 0.02;          // metres, under the board
constexpr double kLongestPage = 14'400.0;  // points: PDF's limit

// The black runs of a marker's rows, from its top left corner on.
void add_marker(const MarkerCells& cells,
                const glm::dvec2& corner,
                double side,
                std::vector<BoardPatch>& patches) {
    const double cell = side / cells.side;
    for (int row = 0; row < cells.side; ++row) {
        const std::size_t start =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.side);
        for (int from = 0; from < cells.side;) {
            int to = from;
            while (to < cells.side && !cells.is_white[start + static_cast<std::size_t>(to)]) {
                ++to;
            }
            if (to > from) {
                patches.push_back({corner + cell * glm::dvec2(from, row),
                                   cell * glm::dvec2(to - from, 1.0),
                                   true});
            }
            from = std::max(to, from + 1);
        }
    }
}

std::string rectangle_text(const BoardPatch& patch, double left, double top) {
    return fmt::format("{} g {:.4f} {:.4f} {:.4f} {:.4f} re f\n",
                       patch.is_black ? 0 : 1,
                       (left + patch.corner.x) * kPointsPerMetre,
                       (top - patch.corner.y - patch.size.y) * kPointsPerMetre,
                       patch.size.x * kPointsPerMetre,
                       patch.size.y * kPointsPerMetre);
}

// The objects of a PDF of one page, with the table of where each begins.
std::string pdf_of(double width, double height, const std::string& drawing) {
    const std::vector<std::string> objects = {
        "<< /Type /Catalog /Pages 2 0 R >>",
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.4f} {:.4f}] /Contents 4 0 R "
                    "/Resources << /Font << /F1 5 0 R >> >> >>",
                    width,
                    height),
        fmt::format("<< /Length {} >>\nstream\n{}endstream", drawing.size(), drawing),
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
    std::string text = "%PDF-1.4\n";
    std::string table = fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        table += fmt::format("{:010} 00000 n \n", text.size());
        text += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
    }
    return text + fmt::format("{}trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n",
                              table,
                              objects.size() + 1,
                              text.size());
}

// Fills a rectangle, its edges rounded to pixels.
void fill(BoardPicture& picture, const BoardPatch& patch, double pixels_per_metre) {
    const auto pixel = [&](double metres, int limit) {
        const double at = std::round(metres * pixels_per_metre) + picture.margin;
        return std::clamp(static_cast<int>(at), 0, limit);
    };
    const int left = pixel(patch.corner.x, picture.width);
    const int right = pixel(patch.corner.x + patch.size.x, picture.width);
    const int bottom = pixel(patch.corner.y + patch.size.y, picture.height);
    for (int y = pixel(patch.corner.y, picture.height); y < bottom; ++y) {
        const auto row = picture.pixels.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
        std::fill(row + left, row + right, patch.is_black ? std::uint8_t{0} : std::uint8_t{255});
    }
}

}  // namespace

std::vector<BoardPatch> board_patches(const Board& board) {
    const glm::dvec2 whole(board.square * board.columns, board.square * board.rows);
    std::vector<BoardPatch> patches = {{{}, whole, false}};
    std::size_t marker = 0;
    const double inset = 0.5 * (board.square - board.marker);
    for (int row = 0; row < board.rows; ++row) {
        for (int column = 0; column < board.columns; ++column) {
            const glm::dvec2 corner = board.square * glm::dvec2(column, row);
            if ((row + column) % 2 == 0) {
                patches.push_back({corner, glm::dvec2(board.square), true});
            } else if (board.kind == BoardKind::charuco) {
                add_marker(marker_cells(board.dictionary, marker++),
                           corner + glm::dvec2(inset),
                           board.marker,
                           patches);
            }
        }
    }
    if (board.is_inverted) {
        for (BoardPatch& patch : patches) {
            patch.is_black = !patch.is_black;
        }
    }
    return patches;
}

std::string board_caption(const Board& board) {
    const std::string squares =
        fmt::format("{} x {} squares of {:.4g} mm", board.columns, board.rows, board.square * 1e3);
    const std::string inverted = board.is_inverted ? ", inverted" : "";
    return board.kind == BoardKind::chessboard ? squares + inverted
                                               : fmt::format("{}, markers of {:.4g} mm, {}{}",
                                                             squares,
                                                             board.marker * 1e3,
                                                             board.dictionary,
                                                             inverted);
}

Expected<std::string> board_pdf(const Board& board) {
    const double width = board.square * board.columns + 2.0 * kMargin;
    const double height = board.square * board.rows + 2.0 * kMargin + kCaption;
    if (std::max(width, height) * kPointsPerMetre > kLongestPage) {
        return fail(
            fmt::format("the page would be {:.1f} x {:.1f} m, PDF knows 5 m at most; draw a "
                        "picture (.png) instead",
                        width,
                        height));
    }
    std::string drawing;
    for (const BoardPatch& patch : board_patches(board)) {
        drawing += rectangle_text(patch, kMargin, height - kMargin);
    }
    // Under the board: a line of 100 mm, and what it is.
    const double foot = kMargin + 0.4 * kCaption;
    drawing += rectangle_text({{}, {0.1, 0.0005}, true}, kMargin, foot);
    drawing += fmt::format(
        "0 g BT /F1 9 Tf {:.4f} {:.4f} Td ({}; the line is 100 mm: print at 100 %, then measure) "
        "Tj "
        "ET\n",
        kMargin * kPointsPerMetre,
        (foot + 0.002) * kPointsPerMetre,
        board_caption(board));
    return pdf_of(width * kPointsPerMetre, height * kPointsPerMetre, drawing);
}

Expected<BoardPicture> draw_board(const Board& board, int pixels_per_square) {
    constexpr int kSmallest = 10;
    constexpr int kLargest = 400;
    constexpr double kMostPixels = 1e8;
    if (pixels_per_square < kSmallest || pixels_per_square > kLargest) {
        return fail(fmt::format(
            "a square of {} pixels, must be {} to {}", pixels_per_square, kSmallest, kLargest));
    }
    BoardPicture picture;
    picture.margin = pixels_per_square / 2;
    picture.width = board.columns * pixels_per_square + 2 * picture.margin;
    picture.height = board.rows * pixels_per_square + 2 * picture.margin;
    if (static_cast<double>(picture.width) * picture.height > kMostPixels) {
        return fail(fmt::format("a picture of {} x {} pixels is too large; fewer pixels a square",
                                picture.width,
                                picture.height));
    }
    const std::uint8_t paper = board.is_inverted ? 0 : 255;
    picture.pixels.assign(
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), paper);
    for (const BoardPatch& patch : board_patches(board)) {
        fill(picture, patch, pixels_per_square / board.square);
    }
    return picture;
}

}  // namespace raks::capture
