#include "apps/raks_capture/calibrate_dancer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/filmed_boards.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "apps/raks_capture/keypoint_step.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "motion/capture/calibration/lens_fit.hpp"
#include "motion/capture/keypoints/still_camera.hpp"
#include "motion/capture/markerless/rough_clocks.hpp"

namespace raks::apps {
namespace {

double view_of(const capture::Lens& lens) {
    return 2.0 * std::atan(0.5 * std::max(lens.width, lens.height) / lens.fx) * 180.0 / M_PI;
}

}  // namespace

double dancer_height(const CapturePlan& plan, double given) {
    if (given > 0.0) {
        return given;
    }
    if (plan.height > 0.0) {
        return plan.height;
    }
    say(
        fmt::format("the dancer's height is not known: {:.2f} m are assumed, from which the size "
                    "of everything follows (--height, or height = in capture.toml)",
                    capture::kUsualHeight));
    return capture::kUsualHeight;
}

Expected<std::vector<capture::DancerCamera>> dancer_cameras(
    const CapturePlan& plan, const std::vector<capture::KeypointFilm>& films) {
    std::vector<capture::DancerCamera> cameras;
    cameras.reserve(films.size());
    for (const capture::KeypointFilm& film : films) {
        cameras.push_back({film.camera,
                           film.width,
                           film.height,
                           std::nullopt,
                           capture::surely_stood_still(film)});
    }
    const bool has_boards =
        std::all_of(plan.cameras.begin(), plan.cameras.end(), [](const PlannedCamera& camera) {
            return !camera.calibration.empty();
        });
    if (!has_boards) {
        say(
            fmt::format("no film of the board: lenses are guessed ({:.0f} degrees across) and "
                        "refined",
                        capture::kGuessedView));
        return cameras;
    }
    BoardSearch search;
    search.is_stop_requested = [] { return stop_signal().has_value(); };
    const auto boards = find_filmed_boards(plan, search);
    if (!boards) {
        return fail(boards.error());
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const capture::FilmedCamera& filmed = boards->cameras[i];
        auto lens = capture::fit_lens(filmed.width, filmed.height, plan.board, filmed.lens_views);
        if (!lens) {
            return fail(std::move(lens.error()).in(filmed.name));
        }
        if (filmed.width != cameras[i].width || filmed.height != cameras[i].height) {
            return fail(
                fmt::format("{}: its film of the board has pictures of {} x {}, that of the dance "
                            "{} x {}: film "
                            "both alike",
                            filmed.name,
                            filmed.width,
                            filmed.height,
                            cameras[i].width,
                            cameras[i].height));
        }
        cameras[i].lens = lens->lens;
    }
    return cameras;
}

Expected<capture::DancerCalibration> calibrate_by_dancer(const CapturePlan& plan, double height) {
    const auto seen = load_keypoint_take(plan);
    if (!seen) {
        return fail(seen.error());
    }
    if (std::string mirrored = capture::why_mirrored(seen->films, seen->clocks);
        !mirrored.empty()) {
        return fail(std::move(mirrored));
    }
    const auto cameras = dancer_cameras(plan, seen->films);
    if (!cameras) {
        return fail(cameras.error());
    }
    ProgressLine progress("fitting cameras to the dancer");
    progress.show(0.0);
    return capture::calibrate_by_dancer(seen->take, *cameras, height);
}

std::string dancer_report_text(const capture::DancerCalibration& done) {
    std::string text =
        fmt::format("{:16} {:>8} {:>9}   place, m\n", "camera", "degrees", "error px");
    for (std::size_t i = 0; i < done.rig.cameras.size(); ++i) {
        const capture::Camera& camera = done.rig.cameras[i];
        const glm::dvec3 centre = camera.centre();
        text += fmt::format("{:16} {:8.1f} {:9.1f}   {:.2f} {:.2f} {:.2f}\n",
                            camera.name,
                            view_of(camera.lens),
                            done.adjusted.camera_rms[i],
                            centre.x,
                            centre.y,
                            centre.z);
    }
    for (const capture::CameraPair& pair : done.pairs) {
        text += fmt::format("{} and {}: {:.0f} degrees apart, {:.0f} % of {} joints agree\n",
                            done.rig.cameras[pair.from].name,
                            done.rig.cameras[pair.to].name,
                            pair.angle,
                            100.0 * pair.agreeing,
                            pair.shared);
    }
    return text + fmt::format("floor by {} standing feet, within {:.0f} mm\n",
                              done.floor.steps,
                              1e3 * done.floor.spread);
}

std::string dancer_report_json(const capture::DancerCalibration& done) {
    Json cameras = Json::array();
    for (std::size_t i = 0; i < done.rig.cameras.size(); ++i) {
        const capture::Camera& camera = done.rig.cameras[i];
        const glm::dvec3 centre = camera.centre();
        cameras.push_back({{"name", camera.name},
                           {"view_degrees", view_of(camera.lens)},
                           {"rms_px", done.adjusted.camera_rms[i]},
                           {"place_m", {centre.x, centre.y, centre.z}}});
    }
    Json pairs = Json::array();
    for (const capture::CameraPair& pair : done.pairs) {
        pairs.push_back(
            {{"cameras", {done.rig.cameras[pair.from].name, done.rig.cameras[pair.to].name}},
             {"degrees", pair.angle},
             {"agreeing", pair.agreeing},
             {"joints", pair.shared}});
    }
    const Json report = {{"cameras", cameras},
                         {"pairs", pairs},
                         {"floor_steps", done.floor.steps},
                         {"floor_spread_mm", 1e3 * done.floor.spread},
                         {"doubts", done.doubts}};
    return report.text(2) + "\n";
}

}  // namespace raks::apps
