#include "apps/raks_capture/capture_command_table.hpp"

#include <algorithm>
#include <utility>

#include "apps/clips/body_options.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/terminal/option_checks.hpp"

namespace raks::apps {
namespace {

void add_run(CommandTable& table) {
    const auto [app, arguments] =
        table.add<RunArguments>(table.app(),
                                "run",
                                "do every step that is missing or older than what it is made from",
                                &run_capture);
    app->add_option("folder", arguments->folder, "the capture")->required();
    auto* const markerless =
        app->add_flag("--markerless",
                      arguments->is_markerless,
                      "without markers and board, from two cameras on; a folder of films will do");
    app->add_option(
           "--height", arguments->height, "metres of the dancer, for a folder without capture.toml")
        ->check(in_range(0.8, 2.5))
        ->needs(markerless);
    app->add_option("--music", arguments->music, "the song that was played, likewise")
        ->needs(markerless);
}

void add_simulate(CommandTable& table) {
    const auto [app, arguments] = table.add<SimulateArguments>(
        table.app(), "simulate", "film a known dance with simulated cameras", &simulate);
    app->add_option("motion", arguments->motion, "motion file")->required();
    app->add_option("-o,--out", arguments->output, "folder to make")->required();
    auto* const points =
        app->add_flag("--points",
                      arguments->points,
                      "write where markers are in the pictures, but draw no pictures");
    app->add_flag("--draft", arguments->is_draft, "draw films at single size, without blur");
    auto* const known = app->add_flag("--known-rig",
                                      arguments->is_rig_known,
                                      "draw no calibration films: write where the cameras are");
    app->add_flag("--no-board",
                  arguments->has_no_board,
                  "draw no calibration films, and do not write where the cameras are either")
        ->excludes(known)
        ->excludes(points);
    app->add_flag("--no-markers",
                  arguments->has_no_markers,
                  "film the dancer in plain clothes, without markers")
        ->excludes(points);
    app->add_option("--music", arguments->music, "music that is heard in the films, of 48,000 Hz");
    app->add_option("--rig", arguments->rig, "cameras (TOML); without: a ring of 4 m");
    app->add_option("--cameras", arguments->cameras, "how many the ring has")
        ->check(in_range(2, 32));
    app->add_option("--camera-angle",
                    arguments->camera_angle,
                    "degrees between neighbours, at hand-held height; without: evenly around")
        ->check(in_range(1.0, 180.0));
    app->add_option("--markers", arguments->markers, "marker set (TOML)");
    app->add_flag("--unique", arguments->unique, "give each marker a colour of its own");
    app->add_option("--fps", arguments->fps, "frames a second of the motion")
        ->check(in_range(1.0, 1000.0));
    app->add_option(
           "--rate", arguments->rates, "pictures a second of the cameras, or of one: cam2=24")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app->add_option("--bump",
                    arguments->bumps,
                    "somebody bumps into a camera at a second of its film: cam2=12.5")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app->add_option("--rolling-shutter",
                    arguments->rolling_shutter,
                    "milliseconds between the first row of a picture and the last")
        ->check(in_range(0.0, 100.0));
    app->add_option("--shutter",
                    arguments->shutter,
                    "milliseconds for which a picture gathers light: what moves is smeared")
        ->check(in_range(0.1, 100.0));
    app->add_option("--light", arguments->light, "light of the room, as a share of the usual")
        ->check(in_range(0.05, 4.0));
    app->add_option("--people",
                    arguments->studio.people,
                    "2: somebody without markers walks through behind the dancer")
        ->check(CLI::IsMember({1, 2}));
    app->add_option("--tempo", arguments->tempo, "danced so many times as fast")
        ->check(in_range(0.1, 10.0));
    app->add_option("--duration", arguments->seconds, "seconds to film")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
    app->add_option("--noise", arguments->studio.noise, "error of each point in a picture, pixels")
        ->check(in_range(0.0, 20.0));
    app->add_option("--drop", arguments->studio.drop, "share of the points that no camera finds")
        ->check(in_range(0.0, 1.0));
    app->add_option("--clutter", arguments->studio.clutter, "false points in each picture")
        ->check(in_range(0, 1000));
    app->add_option(
           "--clock-error", arguments->studio.clock_error, "error of each camera's clock, seconds")
        ->check(in_range(0.0, 60.0));
    app->add_option(
           "--drift", arguments->studio.drift_ppm, "drift of each clock, parts in a million")
        ->check(in_range(0.0, 1000.0));
    app->add_option("--seed", arguments->studio.seed, "same seed, same films");
    add_body_options(*app, arguments->body);
}

void add_board(CommandTable& table) {
    const auto [app, arguments] = table.add<BoardArguments>(
        table.app(), "board", "draw the board that calibrates the cameras, to print", &draw_board);
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
    app->add_option(
        "--dictionary", arguments->dictionary, "which markers, by OpenCV's name of the set");
    app->add_flag("--inverted", arguments->is_inverted, "black and white exchanged");
    app->add_option("--pixels", arguments->pixels, "size of a square in a picture, pixels")
        ->check(in_range(10, 400));
}

void add_calibrate(CommandTable& table) {
    const auto [app, arguments] = table.add<CalibrationArguments>(
        table.app(),
        "calibrate",
        "find lenses and places of the cameras with a printed board, or by the dancer",
        &calibrate);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("-o,--out", arguments->output, "the rig (rig.toml of the folder)");
    CalibrationChoices& choices = arguments->choices;
    app->add_option("--clocks", choices.clocks, "clocks of the calibration films (TOML)");
    app->add_option("--every", choices.every, "seconds between the pictures that are looked at")
        ->check(in_range(0.01, 60.0));
    app->add_option("--coefficients",
                    choices.coefficients,
                    "how many numbers describe a lens's distortion: 5, or 8 for wide lenses")
        ->check(CLI::IsMember({5, 8}));
    auto* const floor =
        app->add_option("--floor", choices.floor, "when the board lay on the floor, seconds")
            ->check(in_range(0.0, 86400.0));
    app->add_option("--floor-picture",
                    choices.floor_picture,
                    "the same by the number of the picture, for folders of pictures")
        ->check(in_range(0, 1'000'000))
        ->excludes(floor);
    auto* const rig = app->add_option(
        "--rig", arguments->rig, "cameras that another program calibrated, instead of a board");
    app->add_option("--unit", arguments->unit, "unit of that rig, where its file does not say")
        ->check(one_of({"m", "mm"}))
        ->needs(rig);
    app->add_option("--up", arguments->up, "which axis of that rig points up")
        ->check(one_of({"y", "z"}))
        ->needs(rig);
    auto* const dancer =
        app->add_flag("--dancer",
                      arguments->is_by_dancer,
                      "without a board: by the joints of the dancer (raks capture keypoints)");
    dancer->excludes(rig);
    app->add_option("--height", arguments->height, "metres of the dancer, from which sizes follow")
        ->check(in_range(0.8, 2.5))
        ->needs(dancer);
    app->add_flag("--json", arguments->as_json, "print the report as JSON");
}

void add_sync(CommandTable& table) {
    auto [app, a] =
        table.add<SyncArguments>(table.app(),
                                 "sync",
                                 "find how the clocks of the films differ, by their sound",
                                 &sync_capture);
    app->add_option("FOLDER", a->folder, "folder of the capture, with its capture.toml")
        ->required();
    app->add_option("--music", a->music, "the song that was played; else what capture.toml names");
    app->add_option("--offsets", a->offsets, "clocks set by hand (clocks.toml)");
    app->add_option("--within", a->within, "seconds within which all cameras were started")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
    app->add_flag(
        "--boards", a->is_of_boards, "tell the clocks of the calibration films, for calibrate");
    app->add_flag("--json", a->as_json, "print JSON");
}

void add_label(CommandTable& table) {
    const auto [app, arguments] = table.add<LabelArguments>(
        table.app(), "label", "tell which marker is where, in the first pictures", &label_capture);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("--labels",
                    arguments->labels,
                    "table of labels (TSV), checked and taken over; without: a window");
}

void add_track_by_angles(CLI::App& app, TrackArguments& arguments) {
    app.add_option("--method",
                   arguments.method,
                   "follow each marker by itself, or the whole body; or a dancer without markers")
        ->check(one_of({"positions", "angles", "markerless"}));
    app.add_option("--body",
                   arguments.body,
                   "angles: which joints move: dance, paper, or a file of joints (TOML)");
    app.add_flag("--no-fit",
                 arguments.is_body_kept,
                 "angles: a body as its height says, not fitted to the first seconds");
    app.add_option("--likelihood", arguments.likelihood, "angles: what a posture is judged by")
        ->check(one_of({"reprojection", "epipolar"}));
    app.add_option("--filter", arguments.filter, "angles: limb by limb, or all joints at once")
        ->check(one_of({"partitioned", "full"}));
    app.add_option("--particles", arguments.particles, "angles: postures that are tried at once")
        ->check(in_range(8, 100'000));
    app.add_option("--layers", arguments.layers, "angles: how often they are drawn together")
        ->check(in_range(3, 100));
    app.add_flag("--no-polish",
                 arguments.is_unpolished,
                 "angles: without the least-squares fit that ends a frame");
    app.add_option(
           "--body-error",
           arguments.body_error,
           "angles: make each length of the body wrong by such a share, to see what it does")
        ->check(in_range(0.0, 0.5));
    app.add_option("--seed", arguments.seed, "angles: same seed, same dance");
    app.add_option("--threads", arguments.threads, "angles: cores to use (all)")
        ->check(in_range(1, 256));
}

void add_track(CommandTable& table) {
    const auto [app, arguments] = table.add<TrackArguments>(
        table.app(), "track", "follow the markers through all films", &track);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("--labels",
                    arguments->labels,
                    "table that tells which marker is where, in the first pictures (TSV)");
    app->add_option("--colour", arguments->colour, "how colours are told apart")
        ->check(CLI::IsMember({"normalised", "crcb"}));
    app->add_option("--sigma", arguments->sigma, "error of a point in a picture, pixels")
        ->check(in_range(0.01, 20.0));
    app->add_option("--acceleration", arguments->acceleration, "of markers when followed, m/s^2")
        ->check(in_range(0.1, 1000.0));
    app->add_option("--smoothing", arguments->smoothing, "the same when smoothed afterwards")
        ->check(in_range(0.1, 1000.0));
    app->add_flag("--as-named",
                  arguments->is_as_named,
                  "take each film as its camera's, even where it fits another one");
    app->add_option("--truth", arguments->truth, "folder with true tracks, to be compared with");
    add_track_by_angles(*app, *arguments);
}

void add_keypoints(CommandTable& table) {
    const auto [app, arguments] =
        table.add<KeypointArguments>(table.app(),
                                     "keypoints",
                                     "find the joints of a dancer without markers, in all films",
                                     &keypoints);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("--pose-model",
                    arguments->network,
                    "network that finds joints: lite, full or heavy, or its file");
    app->add_flag("--preview",
                  arguments->is_preview,
                  "look at every third picture, with the network lite where it is there");
    app->add_option("--threads", arguments->threads, "cores to use, one a film (all)")
        ->check(in_range(1, 256));
    TakenKeypoints& taken = arguments->taken;
    auto* const from = app->add_option("--from",
                                       taken.from,
                                       "CAMERA=PATH: joints that another program found: OpenPose's "
                                       "folder of JSON, or a table; once a camera");
    app->add_option("--map", taken.map, "what its names mean (TSV)")->needs(from);
    app->add_option(
           "--fps", taken.pictures_per_second, "pictures a second, of cameras without film")
        ->check(in_range(1.0, 1000.0))
        ->needs(from);
    app->add_option("--size", taken.size, "size of the pictures, likewise, such as 1920x1080")
        ->needs(from);
}

void add_correct(CommandTable& table) {
    const auto [app, arguments] = table.add<CorrectArguments>(
        table.app(), "correct", "look at the tracks and put them right, in a window", &correct);
    app->add_option("folder", arguments->folder, "the capture")->required();
}

void add_solve(CommandTable& table) {
    const auto [app, arguments] = table.add<SolveArguments>(
        table.app(),
        "solve",
        "find the dancer's body and its dance in the tracks, or in anybody's points",
        &solve_capture);
    app->add_option("folder", arguments->folder, "the capture, or a file of points (TRC, C3D, CSV)")
        ->required();
    app->add_option("-o,--out", arguments->output, "points: the dance (BVH); without: beside it");
    app->add_option("--unit", arguments->unit, "points: their unit, where the file is wrong")
        ->check(one_of({"m", "cm", "mm"}));
    app->add_option("--up", arguments->up, "points: which axis is up, likewise")
        ->check(one_of({"x", "y", "z"}));
    app->add_option("--names", arguments->names, "points: which joints their names mean (TSV)");
    app->add_option("--markers", arguments->markers, "points: the marker set that they are (TOML)");
    app->add_option("--height", arguments->height, "metres of the dancer")
        ->check(in_range(0.8, 2.5));
    app->add_option("--fps", arguments->frames_per_second, "frames a second of the dance")
        ->check(in_range(1.0, 1000.0));
    app->add_option(
        "--body", arguments->body, "which joints move: dance, paper, or a file of joints (TOML)");
    app->add_option("--smoothness", arguments->smoothness, "above 1: softer, below: sharper")
        ->check(in_range(0.05, 20.0));
    app->add_flag("--json", arguments->as_json, "print the figures as JSON");
}

void add_report(CommandTable& table) {
    const auto [app, arguments] = table.add<ReportArguments>(
        table.app(), "report", "show what came of a capture, as a page", &report_capture);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("--truth", arguments->truth, "folder with true tracks, to be compared with");
    app->add_option("-o,--out", arguments->output, "page (HTML); without: report.html in it");
}

void add_compare(CommandTable& table) {
    const auto [app, arguments] = table.add<CompareArguments>(
        table.app(), "compare", "how far two motions of the same dance are apart", &compare);
    app->add_option("one", arguments->one, "a motion, such as the true one")->required();
    app->add_option("other", arguments->other, "another one")->required();
    app->add_option("--shift", arguments->shift, "seconds by which the other one begins later")
        ->check(in_range(-86400.0, 86400.0));
    app->add_flag("--align",
                  arguments->is_aligned,
                  "turn the other one about the vertical and move it, so that it fits best");
    app->add_flag("--json", arguments->as_json, "print JSON");
}

}  // namespace

void add_commands(CommandTable& table) {
    table.app().require_subcommand(1);
    add_run(table);
    add_simulate(table);
    add_board(table);
    add_calibrate(table);
    add_sync(table);
    add_label(table);
    add_track(table);
    add_keypoints(table);
    add_correct(table);
    add_solve(table);
    add_report(table);
    add_compare(table);
}

ExitCode run_command_line(std::vector<std::string> words) {
    CommandTable table("", "raks capture");
    add_commands(table);
    // CLI11 takes the words from the last to the first.
    std::reverse(words.begin(), words.end());
    table.app().parse(std::move(words));
    return table.chosen()();
}

}  // namespace raks::apps
