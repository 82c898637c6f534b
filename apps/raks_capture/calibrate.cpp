// `raks capture calibrate`: the cameras of a capture, from what they saw of a board.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "apps/raks_capture/commands.hpp"
#include "apps/raks_capture/filmed_boards.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/capture/camera/rig_file.hpp"

#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

/// Arguments of `raks capture calibrate`.
struct CalibrateArguments {
    Path folder;
    Path output;  ///< empty: rig.toml of the folder
    Path clocks;  ///< of the calibration films; empty: all began at once
    double every = 0.5;
    int coefficients = 5;
    std::optional<double> floor;  ///< seconds
    std::optional<int> floor_picture;
    bool as_json = false;
};

using Json = nlohmann::ordered_json;

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

Expected<BoardSearch> search_of(const CalibrateArguments& arguments, ProgressLine& progress) {
    BoardSearch search;
    search.every = arguments.every;
    search.on_progress = [&progress](double share) { progress.show(share); };
    if (!arguments.clocks.empty()) {
        constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
        const auto text = read_text_file(arguments.clocks, kMostBytes);
        if (!text) {
            return fail(text.error());
        }
        auto clocks = capture::read_clocks(*text, arguments.clocks.string());
        if (!clocks) {
            return fail(std::move(clocks.error()));
        }
        search.clocks = std::move(*clocks);
    }
    return search;
}

Expected<capture::RigCalibration> calibrate_films(const CapturePlan& plan,
                                                  const CalibrateArguments& arguments) {
    ProgressLine progress("looking for the board");
    const auto search = search_of(arguments, progress);
    if (!search) {
        return fail(search.error());
    }
    const auto boards = find_filmed_boards(plan, *search);
    if (!boards) {
        return fail(boards.error());
    }
    for (const std::string& warning : boards->warnings) {
        say(warning);
    }
    capture::CalibrationSettings settings;
    settings.coefficients = arguments.coefficients;
    if (arguments.floor_picture) {
        settings.floor_moment = static_cast<std::size_t>(*arguments.floor_picture);
    } else if (arguments.floor) {
        settings.floor_moment =
            static_cast<std::size_t>(std::round(*arguments.floor / arguments.every));
    }
    progress.show("fitting cameras");
    return capture::calibrate_rig(plan.board, boards->cameras, boards->sightings, settings);
}

ExitCode calibrate(const CalibrateArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    const auto done = calibrate_films(*plan, arguments);
    if (!done) {
        return fail(Error(done.error()).in(arguments.folder.string()));
    }
    const Path output = arguments.output.empty() ? plan->file("rig.toml") : arguments.output;
    if (const auto written = write_file(output, capture::rig_text(done->rig)); !written) {
        return fail(written.error());
    }
    for (const std::string& doubt : done->doubts) {
        say(doubt);
    }
    if (arguments.as_json) {
        print_json(report_json(*done).dump(2) + "\n");
    } else {
        print_text(report_text(*done));
    }
    return kExitDone;
}

}  // namespace

void add_calibrate(CommandTable& table) {
    const auto [app, arguments] = table.add<CalibrateArguments>(
        table.app(), "calibrate", "find lenses and places of the cameras by a board", &calibrate);
    app->add_option("folder", arguments->folder, "the capture")->required();
    app->add_option("-o,--out", arguments->output, "the rig (rig.toml of the folder)");
    app->add_option("--clocks", arguments->clocks, "clocks of the calibration films (TOML)");
    app->add_option("--every", arguments->every, "seconds between the pictures that are looked at")
        ->check(in_range(0.01, 60.0));
    app->add_option(
           "--coefficients", arguments->coefficients, "of the distortion: 5, or 8 for wide lenses")
        ->check(CLI::IsMember({5, 8}));
    auto* const floor =
        app->add_option("--floor", arguments->floor, "when the board lay on the floor, seconds")
            ->check(in_range(0.0, 86400.0));
    app->add_option("--floor-picture",
                    arguments->floor_picture,
                    "the same by number, of folders of pictures")
        ->check(in_range(0, 1'000'000))
        ->excludes(floor);
    app->add_flag("--json", arguments->as_json, "print the report as JSON");
}

}  // namespace raks::apps
