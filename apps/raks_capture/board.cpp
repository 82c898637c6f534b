// `raks capture board`: the board to print.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/calibration/board_drawing.hpp"
#include "render/video/png.hpp"

namespace raks::apps {
namespace {

Expected<capture::Board> board_of(const BoardArguments& arguments) {
    if (!arguments.capture.empty()) {
        const auto plan = load_capture_plan(arguments.capture);
        return plan ? Expected<capture::Board>(plan->board) : fail(plan.error());
    }
    capture::Board board;
    board.kind = arguments.kind == "chessboard" ? capture::BoardKind::chessboard
                                                : capture::BoardKind::charuco;
    board.columns = arguments.columns;
    board.rows = arguments.rows;
    board.square = arguments.square / 1000.0;
    board.marker = arguments.marker > 0.0 ? arguments.marker / 1000.0 : 0.75 * board.square;
    board.dictionary = arguments.dictionary;
    board.is_inverted = arguments.is_inverted;
    const auto checked = capture::check_board(board);
    return checked ? Expected<capture::Board>(board) : fail(checked.error());
}

Expected<void> write_picture(const capture::Board& board, const BoardArguments& arguments) {
    const auto picture = capture::draw_captioned_board(board, arguments.pixels);
    if (!picture) {
        return fail(picture.error());
    }
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * picture->pixels.size());
    for (const std::uint8_t grey : picture->pixels) {
        rgba.insert(rgba.end(), {grey, grey, grey, 255});
    }
    return render::write_png(arguments.output, picture->width, picture->height, rgba);
}

}  // namespace

ExitCode draw_board(const BoardArguments& arguments) {
    const auto board = board_of(arguments);
    if (!board) {
        return fail(board.error());
    }
    const std::string ending = arguments.output.extension().string();
    Expected<void> written;
    if (ending == ".pdf") {
        const auto pdf = capture::board_pdf(*board);
        written = pdf ? write_file(arguments.output, *pdf) : fail(pdf.error());
    } else if (ending == ".png") {
        written = write_picture(*board, arguments);
    } else {
        return fail(fmt::format("{}: a board is drawn as .pdf or .png", arguments.output.string()));
    }
    if (!written) {
        return fail(written.error());
    }
    say(fmt::format("{}: {}; print it at 100 %, glue it on something flat, and measure a square",
                    arguments.output.string(),
                    capture::board_caption(*board)));
    return kExitDone;
}

}  // namespace raks::apps
