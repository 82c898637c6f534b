#include "apps/raks_capture/motion_clocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "apps/raks_capture/keypoint_files.hpp"
#include "base/file.hpp"
#include "motion/capture/dancer_rig/dancer_calibration.hpp"
#include "motion/capture/markerless/motion_sync.hpp"

namespace raks::apps {
namespace {

constexpr double kRate = 30.0;      // frames a second that cameras are placed by
constexpr double kMostOff = 0.025;  // seconds between sound and motion that are not said

// The joints of a network tremble, and so do these clocks: drift is left to what is heard.
Expected<capture::MotionSync> refined(const CapturePlan& plan,
                                      const std::vector<capture::KeypointFilm>& films,
                                      const std::vector<capture::Clock>& start) {
    const auto take = capture::keypoint_take(films, start, kRate);
    if (!take) {
        return fail(take.error());
    }
    std::vector<capture::DancerCamera> cameras;
    double error = 0.0;
    for (std::size_t i = 0; i < films.size(); ++i) {
        cameras.push_back({films[i].camera, films[i].width, films[i].height, std::nullopt});
        error += capture::usual_error(*take, i) / static_cast<double>(films.size());
    }
    const double height = plan.height > 0.0 ? plan.height : capture::kUsualHeight;
    const auto placed = capture::calibrate_by_dancer(*take, cameras, height);
    if (!placed) {
        return fail(placed.error());
    }
    std::vector<capture::MovingSights> sights;
    for (std::size_t i = 0; i < films.size(); ++i) {
        sights.emplace_back(films[i], placed->rig.cameras[i].lens);
    }
    capture::MotionSyncOptions options;
    // Twice what a joint is usually off: a tighter bound follows the trembling.
    options.error = 2.0 * error;
    options.fits_drift = false;
    return capture::sync_by_motion(placed->rig, sights, start, options);
}

const capture::Clock* clock_named(const std::vector<capture::Clock>& clocks,
                                  const std::string& camera) {
    const auto found = std::find_if(clocks.begin(), clocks.end(), [&camera](const auto& clock) {
        return clock.camera == camera;
    });
    return found == clocks.end() ? nullptr : &*found;
}

}  // namespace

bool has_keypoints(const CapturePlan& plan) {
    return plan.cameras.size() >= 2 &&
           std::all_of(plan.cameras.begin(), plan.cameras.end(), [&](const PlannedCamera& camera) {
               return is_there(keypoint_file(plan, camera.name));
           });
}

Expected<std::vector<capture::Clock>> clocks_by_motion(const CapturePlan& plan,
                                                       const std::vector<capture::Clock>& heard,
                                                       double within) {
    const auto films = load_keypoints(plan);
    if (!films) {
        return fail(films.error());
    }
    auto clocks = capture::rough_clocks(*films, within);
    if (!clocks) {
        return clocks;
    }
    // Those that were heard stay, and the others follow the first of them.
    double moved = 0.0;
    for (const capture::Clock& clock : *clocks) {
        if (const capture::Clock* const known = clock_named(heard, clock.camera)) {
            moved = known->offset - clock.offset;
            break;
        }
    }
    for (capture::Clock& clock : *clocks) {
        const capture::Clock* const known = clock_named(heard, clock.camera);
        clock.offset += moved;
        clock = known != nullptr ? *known : clock;
    }
    auto better = refined(plan, *films, *clocks);
    if (!better) {
        return fail(std::move(better.error()));
    }
    for (std::size_t i = 0; i < clocks->size(); ++i) {
        if (clock_named(heard, (*clocks)[i].camera) == nullptr) {
            better->clocks[i].confidence = (*clocks)[i].confidence;
            (*clocks)[i] = better->clocks[i];
        }
    }
    return clocks;
}

std::vector<std::string> check_by_motion(const CapturePlan& plan,
                                         const std::vector<capture::Clock>& heard) {
    const auto films = load_keypoints(plan);
    std::vector<capture::Clock> start;
    for (const PlannedCamera& camera : plan.cameras) {
        if (const capture::Clock* const known = clock_named(heard, camera.name)) {
            start.push_back(*known);
        }
    }
    if (!films || start.size() != films->size()) {
        return {};
    }
    const auto moved = refined(plan, *films, start);
    if (!moved) {
        return {fmt::format("the clocks could not be checked by what moves: {}",
                            moved.error().message)};
    }
    std::vector<std::string> lines;
    double most = 0.0;
    for (std::size_t i = 1; i < start.size(); ++i) {
        const double off = moved->clocks[i].offset - start[i].offset;
        most = std::max(most, std::abs(off));
        if (std::abs(off) > kMostOff) {
            lines.push_back(fmt::format(
                "{}: by what moves its clock is {:.0f} ms {} than by its sound: is sound and "
                "picture of the film in step?",
                start[i].camera,
                1e3 * std::abs(off),
                off > 0.0 ? "later" : "earlier"));
        }
    }
    if (lines.empty()) {
        lines.push_back(
            fmt::format("what moves agrees with the sound within {:.0f} ms", 1e3 * most));
    }
    return lines;
}

}  // namespace raks::apps
