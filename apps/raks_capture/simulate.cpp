// `raks capture simulate`: the test studio.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "apps/raks_capture/calibration_choices.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/drawn_boards.hpp"
#include "apps/raks_capture/drawn_films.hpp"
#include "apps/raks_capture/filmed_motion.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/audio_file.hpp"
#include "base/dice.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/skeleton/formats/bvh.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

Expected<capture::Rig> studio_rig_of(const SimulateArguments& arguments) {
    if (arguments.rig.empty()) {
        if (arguments.camera_angle * arguments.cameras > 360.0) {
            return fail(
                fmt::format("--camera-angle {} with {} cameras: goes more than once around "
                            "the dancer; at most {:.0f} degrees",
                            arguments.camera_angle,
                            arguments.cameras,
                            std::floor(360.0 / arguments.cameras)));
        }
        return arguments.points
                   ? capture::studio_rig(arguments.cameras, 640, 480, arguments.camera_angle)
                   : capture::unlike_cameras_rig(
                         arguments.cameras, 1280, 720, arguments.camera_angle);
    }
    auto file = capture::read_rig(arguments.rig);
    if (!file) {
        return fail(std::move(file.error()));
    }
    for (const std::string& note : file->notes) {
        say(arguments.rig.string() + ": " + note);
    }
    for (const std::string& doubt : capture::rig_doubts(file->rig)) {
        say(arguments.rig.string() + ": " + doubt);
    }
    return std::move(file->rig);
}

Expected<capture::MarkerSet> markers_of(const SimulateArguments& arguments) {
    if (arguments.has_no_markers) {
        return capture::MarkerSet{};
    }
    if (arguments.markers.empty()) {
        return capture::default_markers(arguments.unique ? capture::MarkerColours::unique
                                                         : capture::MarkerColours::five);
    }
    CapturePlan plan;
    plan.markers = std::filesystem::absolute(arguments.markers);
    return load_markers(plan);
}

// What sounds in the room, as the films want it.
Expected<std::vector<float>> music_of(const SimulateArguments& arguments) {
    constexpr int kFilmRate = 48'000;
    if (arguments.music.empty()) {
        return std::vector<float>{};
    }
    auto music = audio::read_all_mono(arguments.music);
    if (!music) {
        return fail(std::move(music.error()));
    }
    if (music->rate.hertz() != kFilmRate) {
        return fail(
            fmt::format("{}: has {} Hz, must have 48000: convert it with ffmpeg -i {} -ar "
                        "48000 NEW.wav",
                        arguments.music.string(),
                        music->rate.hertz(),
                        arguments.music.filename().string()));
    }
    return std::move(music->samples);
}

// How films are drawn, of the dance or of the board.
DrawnFilmOptions film_options(const SimulateArguments& arguments,
                              std::size_t cameras,
                              ProgressLine& progress) {
    DrawnFilmOptions options;
    options.is_draft = arguments.is_draft;
    options.seed = arguments.studio.seed;
    options.tell_progress = [&progress, cameras](
                                std::size_t camera, std::size_t done, std::size_t all) {
        progress.show(
            (static_cast<double>(camera) + static_cast<double>(done) / static_cast<double>(all)) /
            static_cast<double>(cameras));
    };
    options.tell_film = [&progress](const Path& film) {
        progress.reached(film.filename().string() + " is drawn");
    };
    options.is_stop_requested = [] { return stop_signal().has_value(); };
    return options;
}

// The films of the dance, of all cameras, into the capture's folder.
Expected<void> draw_dance(const SimulateArguments& arguments,
                          const Path& folder,
                          const capture::StudioTake& take,
                          const capture::StudioMotion& motion,
                          const capture::Rig& rig,
                          const capture::MarkerSet& markers,
                          const capture::StudioOptions& studio) {
    const auto music = music_of(arguments);
    if (!music) {
        return fail(music.error());
    }
    ProgressLine progress("drawing films");
    DrawnFilmOptions options = film_options(arguments, rig.cameras.size(), progress);
    options.frames_per_second = take.truth.frames_per_second;
    options.music = *music;
    options.rolling_shutter = studio.rolling_shutter;
    options.shutter_seconds =
        arguments.shutter > 0.0 ? 1e-3 * arguments.shutter : options.shutter_seconds;
    options.least_gain *= arguments.light;
    options.greatest_gain *= arguments.light;
    const auto films = draw_films(motion, rig, markers, take.clocks, folder, options, studio);
    return films ? Expected<void>{} : fail(films.error());
}

// The clocks of the calibration films: other recordings of the same cameras, which run as fast or
// slow as for the dance, and were started at other moments. The first camera's is that of all.
std::vector<capture::Clock> board_clocks(const SimulateArguments& arguments,
                                         const std::vector<capture::Clock>& clocks) {
    Dice dice(arguments.studio.seed, 502);
    std::vector<capture::Clock> others = clocks;
    for (capture::Clock& clock : others) {
        clock.offset = dice.uniform(-1.0, 1.0) * arguments.studio.clock_error;
    }
    others.front().offset = 0.0;
    return others;
}

// The calibration films; when the board lies on the floor.
Expected<double> draw_boards(const SimulateArguments& arguments,
                             const Path& folder,
                             const std::vector<capture::Clock>& clocks,
                             const capture::Rig& rig,
                             const capture::Board& board) {
    constexpr double kRate = 5.0;  // the board is held still
    ProgressLine progress("drawing calibration films");
    DrawnFilmOptions options = film_options(arguments, rig.cameras.size(), progress);
    options.frames_per_second = kRate;
    const auto films = draw_board_films(rig, board, clocks, folder, options);
    return films ? Expected<double>(films->floor) : fail(films.error());
}

// What the test studio shows to its cameras: so large that its markers can be read on the floor,
// 4.5 m from cameras that look down on it by 20 to 30 degrees.
capture::Board studio_board() {
    capture::Board board;
    board.square = 0.12;
    board.marker = 0.09;
    return board;
}

// Metres to the loudspeaker as one measures them, to the centimetre.
double loudspeaker_distance(const capture::Camera& camera) {
    return 0.01 *
           std::round(100.0 * glm::distance(camera.centre(), DrawnFilmOptions{}.loudspeaker));
}

CapturePlan plan_of(const SimulateArguments& arguments,
                    const capture::Rig& rig,
                    double frames_per_second) {
    CapturePlan plan;
    plan.height = 1.714;  // the mannequin's
    if (!arguments.has_no_markers) {
        plan.markers = "markers.toml";
    }
    plan.frames_per_second = frames_per_second;
    plan.start = 0.0;
    plan.board = studio_board();
    for (const capture::Camera& camera : rig.cameras) {
        PlannedCamera planned{camera.name, {}, {}, 0.0};
        if (!arguments.points) {
            planned.film = camera.name + ".mp4";
            planned.loudspeaker = loudspeaker_distance(camera);
        }
        if (arguments.has_board_films()) {
            planned.calibration = camera.name + "_board.mp4";
        }
        plan.cameras.push_back(std::move(planned));
    }
    return plan;
}

// The clocks that the capture is given: what a synchronisation by sound would leave open stays
// unknown, so the offsets are those of the plan, nought.
std::vector<capture::Clock> assumed_clocks(const std::vector<capture::Clock>& clocks) {
    std::vector<capture::Clock> assumed = clocks;
    for (capture::Clock& clock : assumed) {
        clock.offset = 0.0;
        clock.drift_ppm = 0.0;
    }
    return assumed;
}

// What is written as a text. What the capture has films to find from is not given, but true.
std::vector<std::pair<std::string, std::string>> texts_of(const SimulateArguments& arguments,
                                                          const capture::StudioTake& take,
                                                          const capture::Rig& rig,
                                                          const capture::MarkerSet& markers) {
    std::vector<std::pair<std::string, std::string>> texts = {
        {"truth/clocks.toml", capture::clocks_text(take.clocks)},
        {"truth/rig.toml", capture::rig_text(rig)},
    };
    if (!arguments.has_no_markers) {
        texts.emplace_back("markers.toml", capture::marker_set_text(markers));
        texts.emplace_back("labels.tsv", capture::labels_text(take.labels));
        texts.emplace_back(arguments.points ? "detections.csv" : "truth/detections.csv",
                           capture::observations_text(take.seen));
        texts.emplace_back("truth/tracks.csv", capture::tracks_text(take.truth));
    }
    if (!arguments.has_board_films() && !arguments.has_no_board) {
        texts.emplace_back("rig.toml", capture::rig_text(rig));
    }
    if (!arguments.has_sound()) {
        texts.emplace_back("clocks.toml", capture::clocks_text(assumed_clocks(take.clocks)));
    }
    return texts;
}

Expected<void> write_take(const SimulateArguments& arguments,
                          const Path& folder,
                          const capture::StudioTake& take,
                          const capture::Rig& rig,
                          const capture::MarkerSet& markers,
                          const FilmedMotion& filmed) {
    std::filesystem::create_directory(folder / "truth");
    for (const auto& [name, text] : texts_of(arguments, take, rig, markers)) {
        if (auto written = write_file(folder / name, text); !written) {
            return written;
        }
    }
    std::vector<motion::Pose> poses;
    for (std::size_t i = 0; i < take.truth.frame_count; ++i) {
        poses.push_back(
            motion::pose_between(filmed.poses, take.truth.time_of(i) * filmed.frames_per_second));
    }
    return motion::write_bvh(folder / "truth/dance.bvh",
                             motion::mannequin_skeleton(),
                             poses,
                             take.truth.frames_per_second);
}

// What a capture consists of, with its films.
Expected<void> write_plan(const SimulateArguments& arguments,
                          const Path& folder,
                          const capture::StudioTake& take,
                          const capture::Rig& rig) {
    const CapturePlan plan = plan_of(arguments, rig, take.truth.frames_per_second);
    if (arguments.has_board_films()) {
        const std::vector<capture::Clock> clocks = board_clocks(arguments, take.clocks);
        const auto floor = draw_boards(arguments, folder, clocks, rig, plan.board);
        if (!floor) {
            return fail(floor.error());
        }
        CalibrationChoices choices;
        choices.floor = *floor;
        const std::pair<const char*, std::string> files[] = {
            {"calibration.toml", calibration_choices_text(choices)},
            {"truth/board_clocks.toml", capture::clocks_text(clocks)}};
        for (const auto& [name, text] : files) {
            if (auto written = write_file(folder / name, text); !written) {
                return written;
            }
        }
    }
    return write_file(folder / "capture.toml", capture_plan_text(plan));
}

// The error to expect from where the cameras stand, by the formula, with as many views as see a
// marker on average.
std::string expectation(const capture::Rig& rig,
                        const capture::StudioTake& take,
                        const capture::StudioOptions& options) {
    if (take.truth.places.empty()) {
        return fmt::format(
            "{} cameras, {} frames, no markers", rig.cameras.size(), take.truth.frame_count);
    }
    double views = 0.0;
    for (const capture::MarkerPlace& place : take.truth.places) {
        views += place.views;
    }
    views /= static_cast<double>(take.truth.places.size());
    double distance = 0.0;
    double f = 0.0;
    for (const capture::Camera& camera : rig.cameras) {
        distance += camera.in_camera({0.0, 0.95, 0.0}).z / static_cast<double>(rig.cameras.size());
        f += camera.lens.fx / static_cast<double>(rig.cameras.size());
    }
    return fmt::format(
        "{} cameras, {} frames; a marker is seen by {:.1f} of them, so that {:.1f} mm are to be "
        "expected (RMS, {:.1f} px)",
        rig.cameras.size(),
        take.truth.frame_count,
        views,
        1000.0 * capture::expected_error(distance, f, options.noise, std::max(views, 1.0)),
        options.noise);
}

// What is said of all cameras ("30") or of one ("cam2=24"), by camera; none: nothing is. Errors: a
// camera that there is not; no number, or one out of range.
Expected<std::vector<std::optional<double>>> by_camera(const std::vector<std::string>& words,
                                                       const char* option,
                                                       double least,
                                                       double most,
                                                       const capture::Rig& rig) {
    std::vector<std::optional<double>> values(rig.cameras.size());
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        const std::string number = word.substr(equals == std::string::npos ? 0 : equals + 1);
        double value = 0.0;
        const auto [end, problem] =
            std::from_chars(number.data(), number.data() + number.size(), value);
        if (problem != std::errc() || end != number.data() + number.size() || !(value >= least) ||
            value > most) {
            return fail(fmt::format("{} {}: must be a number from {} to {}, or CAMERA=NUMBER",
                                    option,
                                    printable(word),
                                    least,
                                    most));
        }
        if (equals == std::string::npos) {
            std::fill(values.begin(), values.end(), value);
            continue;
        }
        const auto camera = rig.index_of(word.substr(0, equals));
        if (!camera) {
            return fail(fmt::format("{} {}: there is no such camera; they are \"{}\" to \"{}\"",
                                    option,
                                    printable(word),
                                    printable(rig.cameras.front().name),
                                    printable(rig.cameras.back().name)));
        }
        values[*camera] = value;
    }
    return values;
}

Expected<capture::StudioOptions> studio_options(const SimulateArguments& arguments,
                                                const capture::Rig& rig,
                                                double frames_per_second) {
    const auto rates = by_camera(arguments.rates, "--rate", 1.0, 1000.0, rig);
    auto bumps = by_camera(arguments.bumps, "--bump", 0.0, 86400.0, rig);
    if (!rates || !bumps) {
        return fail(rates ? bumps.error() : rates.error());
    }
    capture::StudioOptions options = arguments.studio;
    options.first_clock_is_true = !arguments.points;
    options.rolling_shutter = 1e-3 * arguments.rolling_shutter;
    options.bumps = std::move(*bumps);
    options.frames_per_second = 0.0;  // the fastest of the cameras
    for (const std::optional<double>& rate : *rates) {
        options.rates.push_back(rate.value_or(frames_per_second));
        options.frames_per_second = std::max(options.frames_per_second, options.rates.back());
    }
    return options;
}

}  // namespace

ExitCode simulate(const SimulateArguments& arguments) {
    const auto rig = studio_rig_of(arguments);
    const auto markers = markers_of(arguments);
    if (!rig || !markers) {
        return fail(rig ? markers.error() : rig.error());
    }
    const auto filmed = read_filmed_motion(arguments.motion,
                                           {.frames_per_second = arguments.fps,
                                            .tempo = arguments.tempo,
                                            .seconds = arguments.seconds,
                                            .body = arguments.body.options(),
                                            .arm_angle = arguments.body.arm_angle});
    if (!filmed) {
        return fail(filmed.error());
    }
    const auto studio = studio_options(arguments, *rig, filmed->frames_per_second);
    if (!studio) {
        return fail(studio.error());
    }
    const capture::StudioOptions& options = *studio;
    const capture::StudioMotion motion{
        motion::mannequin_skeleton(), filmed->poses, filmed->frames_per_second};
    const capture::StudioTake take = capture::film_points(motion, *rig, *markers, options);
    auto folder = PendingFile::create_folder(arguments.output);
    if (!folder) {
        return fail(std::move(folder.error()));
    }
    auto made = write_take(arguments, folder->part(), take, *rig, *markers, *filmed);
    if (made && !arguments.points) {
        made = draw_dance(arguments, folder->part(), take, motion, *rig, *markers, options);
    }
    if (made) {
        made = write_plan(arguments, folder->part(), take, *rig);
    }
    if (!made) {
        return stop_signal()
                   ? ExitCode(exit_code_after_signals(kExitDone))
                   : fail(named_as(arguments.output, folder->part(), std::move(made.error())));
    }
    if (auto done = folder->commit(); !done) {
        return fail(std::move(done.error()));
    }
    say(expectation(*rig, take, options));
    if (const std::string too_few = too_few_for_colours(*markers, rig->cameras.size());
        !too_few.empty()) {
        say(too_few);
    }
    return kExitDone;
}

}  // namespace raks::apps
