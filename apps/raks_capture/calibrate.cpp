// `raks capture calibrate`: the cameras of a capture, from what they saw of a board.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <string>

#include "apps/raks_capture/calibrate_dancer.hpp"
#include "apps/raks_capture/calibration_choices.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/filmed_boards.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "motion/capture/camera/rig_file.hpp"

namespace raks::apps {
namespace {

constexpr const char* kChoicesFile = "calibration.toml";

Json edges_json(const capture::EdgeErrors& edges) {
    return {{"edges", edges.edges},
            {"mean_mm", edges.mean * 1e3},
            {"rms_mm", edges.rms * 1e3},
            {"bias_mm", edges.bias * 1e3},
            {"worst_mm", edges.worst * 1e3},
            {"reprojection_px", edges.reprojection}};
}

Json report_json(const capture::RigCalibration& done) {
    Json cameras = Json::array();
    Json pairs = Json::array();
    for (std::size_t i = 0; i < done.cameras.size(); ++i) {
        const capture::Camera& camera = done.rig.cameras[i];
        const glm::dvec3 centre = camera.centre();
        cameras.push_back({{"name", camera.name},
                           {"views", done.cameras[i].views},
                           {"lens_rms_px", done.cameras[i].lens_rms},
                           {"rms_px", done.cameras[i].rms},
                           {"place_m", {centre.x, centre.y, centre.z}}});
        for (std::size_t j = i + 1; j < done.cameras.size(); ++j) {
            pairs.push_back({{"cameras", {camera.name, done.rig.cameras[j].name}},
                             {"shared_views", done.shared.between(i, j)}});
        }
    }
    return {{"cameras", cameras},
            {"pairs", pairs},
            {"rms_px", done.rms},
            {"held_out", edges_json(done.held_out)},
            {"has_floor", done.has_floor},
            {"doubts", done.doubts}};
}

std::string report_text(const capture::RigCalibration& done) {
    std::string text =
        fmt::format("{:16} {:>6} {:>9} {:>9}   place, m\n", "camera", "views", "lens px", "rig px");
    for (std::size_t i = 0; i < done.cameras.size(); ++i) {
        const capture::CameraReport& report = done.cameras[i];
        const glm::dvec3 centre = done.rig.cameras[i].centre();
        text += fmt::format("{:16} {:6} {:9.3f} {:9.3f}   {:.2f} {:.2f} {:.2f}\n",
                            done.rig.cameras[i].name,
                            report.views,
                            report.lens_rms,
                            report.rms,
                            centre.x,
                            centre.y,
                            centre.z);
    }
    text += "shared views:";
    for (std::size_t i = 0; i < done.cameras.size(); ++i) {
        for (std::size_t j = i + 1; j < done.cameras.size(); ++j) {
            text += fmt::format(" {}-{} {};",
                                done.rig.cameras[i].name,
                                done.rig.cameras[j].name,
                                done.shared.between(i, j));
        }
    }
    return text + fmt::format(
                      "\nheld-out boards: {} edges, off by {:.2f} mm (RMS), {:.2f} mm at most; "
                      "reprojection {:.3f} px\n",
                      done.held_out.edges,
                      done.held_out.rms * 1e3,
                      done.held_out.worst * 1e3,
                      done.held_out.reprojection);
}

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;  // of a file of clocks or choices
constexpr double kUsuallyEvery = 0.5;                      // seconds

// Clocks that were chosen, else those that `sync --boards` wrote.
Expected<BoardSearch> search_of(const CapturePlan& plan,
                                const CalibrationChoices& choices,
                                ProgressLine& progress) {
    const Path own = plan.file("board_clocks.toml");
    const Path clocks_file = choices.clocks.empty() && is_there(own) ? own : Path(choices.clocks);
    BoardSearch search;
    search.every = choices.every.value_or(kUsuallyEvery);
    search.on_progress = [&progress](double share) { progress.show(share); };
    search.on_camera = [&progress](const std::string& camera, std::size_t found) {
        progress.reached(fmt::format(
            "camera \"{}\" looked at: {} pictures show the board", printable(camera), found));
    };
    search.is_stop_requested = [] { return stop_signal().has_value(); };
    if (!clocks_file.empty()) {
        const auto text = read_text_file(clocks_file, kMostBytes);
        if (!text) {
            return fail(text.error());
        }
        auto clocks = capture::read_clocks(*text, clocks_file.string());
        if (!clocks) {
            return fail(std::move(clocks.error()));
        }
        search.clocks = std::move(*clocks);
    }
    return search;
}

Expected<capture::RigCalibration> calibrate_films(const CapturePlan& plan,
                                                  const CalibrationChoices& choices) {
    ProgressLine progress("looking for the board");
    auto search = search_of(plan, choices, progress);
    if (!search) {
        return fail(search.error());
    }
    if (choices.floor_picture) {
        search->floor_moment = static_cast<std::size_t>(*choices.floor_picture);
    } else if (choices.floor) {
        search->floor_moment = static_cast<std::size_t>(std::round(*choices.floor / search->every));
    }
    const auto boards = find_filmed_boards(plan, *search);
    if (!boards) {
        return fail(boards.error());
    }
    for (const std::string& warning : boards->warnings) {
        say(warning);
    }
    capture::CalibrationSettings settings;
    settings.coefficients = choices.coefficients.value_or(settings.coefficients);
    settings.floor_moment = search->floor_moment;
    progress.show("fitting cameras");
    return capture::calibrate_rig(plan.board, boards->cameras, boards->sightings, settings);
}

// What a person chose before, for what is not said now.
Expected<CalibrationChoices> chosen_before(const CapturePlan& plan) {
    const Path file = plan.file(kChoicesFile);
    if (!is_there(file)) {
        return CalibrationChoices{};
    }
    const auto text = read_text_file(file, kMostBytes);
    return text ? parse_calibration_choices(*text, file.string()) : fail(text.error());
}

// What was chosen is kept for the next time, but for the clocks that `run` itself hands over.
Expected<void> keep_choices(const CapturePlan& plan, CalibrationChoices choices) {
    if (choices.clocks == plan.file("clocks.toml").string()) {
        choices.clocks.clear();
    }
    return choices.are_none()
               ? Expected<void>()
               : write_file(plan.file(kChoicesFile), calibration_choices_text(choices));
}

// The cameras of another program's file become the capture's.
ExitCode take_rig(const CapturePlan& plan,
                  const CalibrationArguments& arguments,
                  const Path& output) {
    capture::RigReading reading;
    if (!arguments.unit.empty()) {
        reading.metres_per_unit = arguments.unit == "mm" ? 0.001 : 1.0;
    }
    if (!arguments.up.empty()) {
        reading.up = arguments.up == "z" ? capture::UpAxis::z : capture::UpAxis::y;
    }
    const auto read = capture::read_rig(arguments.rig, reading);
    if (!read) {
        return fail(read.error());
    }
    for (const PlannedCamera& camera : plan.cameras) {
        if (!read->rig.index_of(camera.name)) {
            std::vector<std::string> names;
            for (const capture::Camera& other : read->rig.cameras) {
                names.push_back(printable(other.name, 40));
            }
            return fail(
                fmt::format("{}: has no camera \"{}\" of capture.toml, but {}: name them alike",
                            arguments.rig.string(),
                            camera.name,
                            fmt::join(names, ", ")));
        }
    }
    for (const auto& lines : {read->notes, capture::rig_doubts(read->rig)}) {
        for (const std::string& line : lines) {
            say(arguments.rig.string() + ": " + line);
        }
    }
    return exit_code_of(write_file(output, capture::rig_text(read->rig)));
}

ExitCode take_dancer(const CapturePlan& plan,
                     const CalibrationArguments& arguments,
                     const Path& output) {
    const auto done = calibrate_by_dancer(plan, dancer_height(plan, arguments.height));
    if (!done) {
        return fail(done.error());
    }
    if (const auto written = write_file(output, capture::rig_text(done->rig)); !written) {
        return fail(written.error());
    }
    for (const auto& lines : {done->doubts, capture::rig_doubts(done->rig)}) {
        for (const std::string& line : lines) {
            say(line);
        }
    }
    if (arguments.as_json) {
        print_json(dancer_report_json(*done));
    } else {
        print_text(dancer_report_text(*done));
    }
    return kExitDone;
}

}  // namespace

ExitCode calibrate(const CalibrationArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const Path output = arguments.output.empty() ? plan->file("rig.toml") : arguments.output;
    if (!arguments.rig.empty()) {
        return take_rig(*plan, arguments, output);
    }
    if (auto checked = check_cameras(*plan); !checked) {
        return fail(std::move(checked.error()));
    }
    if (arguments.is_by_dancer) {
        return take_dancer(*plan, arguments, output);
    }
    const auto before = chosen_before(*plan);
    if (!before) {
        return fail(before.error());
    }
    const CalibrationChoices choices = arguments.choices.over(*before);
    if (choices.floor && !arguments.choices.floor) {
        say(fmt::format("the board lay on the floor at {} s, as before ({})",
                        *choices.floor,
                        plan->file(kChoicesFile).string()));
    }
    const auto done = calibrate_films(*plan, choices);
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    if (!done) {
        return fail(Error(done.error()).in(arguments.folder.string()));
    }
    // First the choices: the rig must not be older than they are.
    if (const auto kept = keep_choices(*plan, choices); !kept) {
        return fail(kept.error());
    }
    if (const auto written = write_file(output, capture::rig_text(done->rig)); !written) {
        return fail(written.error());
    }
    for (const std::string& doubt : done->doubts) {
        say(doubt);
    }
    if (arguments.as_json) {
        print_json(report_json(*done).text(2) + "\n");
    } else {
        print_text(report_text(*done));
    }
    return kExitDone;
}

}  // namespace raks::apps
