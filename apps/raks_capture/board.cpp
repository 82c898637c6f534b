// `raks capture board`: the board to print.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "apps/raks_capture/commands.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/calibration/board_drawing.hpp"
#include "render/video/png.hpp"

namespace raks::apps {
namespace {

/// Arguments of `raks capture board`; lengths in millimetres.
struct BoardArguments {
    Path capture;  ///< folder whose board it is; empty: of the options
    Path output;
    std::string kind = "charuco";
    int columns = 8;
    int rows = 6;
    double square = 80.0;
    double marker = 0.0;  ///< 0: three quarters of a square
    std::string dictionary = "DICT_4X4_1000";
    bool is_inverted = false;
    int pixels = 200;  ///< a square, of a picture
};

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

ExitCode draw(const BoardArguments& arguments) {
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

}  // namespace

void add_board(CommandTable& table) {
    const auto [app, arguments] = table.add<BoardArguments>(
        table.app(), "board", "draw the board that calibrates the cameras, to print", &draw);
    app->add_option("capture", arguments->capture, "folder of a capture, for the board it names");
    app->add_option("-o,--out", arguments->output, "board.pdf, in true size, or board.png")
        ->required();
    app->add_option("--kind", arguments->kind, "charuco or chessboard")
        ->check(one_of({"charuco", "chessboard"}));
    app->add_option("--columns", arguments->columns, "squares across")->check(in_range(3, 100));
    app->add_option("--rows", arguments->rows, "squares down")->check(in_range(3, 100));
    app->add_option("--square", arguments->square, "side of a square, mm")
        ->check(in_range(1.0, 2000.0));
    app->add_option("--marker", arguments->marker, "side of a marker, mm (3/4 of a square)")
        ->check(in_range(1.0, 2000.0));
    app->add_option("--dictionary", arguments->dictionary, "of the markers, by OpenCV's name");
    app->add_flag("--inverted", arguments->is_inverted, "black and white exchanged");
    app->add_option("--pixels", arguments->pixels, "pixels a square, of a picture")
        ->check(in_range(10, 400));
}

}  // namespace raks::apps
