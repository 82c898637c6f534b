#include "apps/raks_capture/motion_clocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/film_detections.hpp"
#include "apps/raks_capture/film_step.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "base/file.hpp"
#include "motion/capture/dancer_rig/dancer_calibration.hpp"
#include "motion/capture/markerless/motion_sync.hpp"
#include "motion/capture/markerless/rough_clocks.hpp"

namespace raks::apps {
namespace {

constexpr double kRate = 30.0;      // frames a second that cameras are placed by
constexpr double kMostOff = 0.025;  // seconds between sound and motion that are not said

/// Cameras that are placed, what moves before them, and how their clocks are told from it.
struct MovingScene {
    capture::Rig rig;
    std::vector<capture::MovingSights> sights;
    capture::MotionSyncOptions options;
};

// The joints of a network tremble, and so do these clocks: drift is left to what is heard.
Expected<MovingScene> scene_of_joints(const CapturePlan& plan,
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
    auto placed = capture::calibrate_by_dancer(*take, cameras, height);
    if (!placed) {
        return fail(std::move(placed.error()));
    }
    MovingScene scene{std::move(placed->rig), {}, {}};
    for (std::size_t i = 0; i < films.size(); ++i) {
        scene.sights.emplace_back(films[i], scene.rig.cameras[i].lens);
    }
    // Twice what a joint is usually off: a tighter bound follows the trembling.
    scene.options.error = 2.0 * error;
    scene.options.fits_drift = false;
    return scene;
}

// Spots of markers, and the rig that a board has calibrated.
Expected<MovingScene> scene_of_spots(const CapturePlan& plan) {
    const auto rig = load_capture_rig(plan);
    const auto markers = rig ? load_markers(plan) : fail(rig.error());
    if (!markers) {
        return fail(markers.error());
    }
    std::vector<capture::MarkerLabel> labels;
    if (is_there(plan.file("labels.tsv"))) {
        auto read = load_labels(plan.file("labels.tsv"));
        if (!read) {
            return fail(std::move(read.error()));
        }
        labels = std::move(*read);
    }
    const auto seen =
        seen_by_cameras(plan, *rig, *markers, labels, capture::ChromaForm::normalised);
    if (!seen) {
        return fail(seen.error());
    }
    MovingScene scene;
    for (const PlannedCamera& camera : plan.cameras) {
        const auto place = rig->index_of(camera.name);
        const auto film =
            std::find_if(seen->films.begin(), seen->films.end(), [&camera](const auto& one) {
                return one.camera == camera.name;
            });
        if (!place || film == seen->films.end()) {
            return fail(camera.name + ": is not calibrated, or no spots of it are there");
        }
        scene.rig.cameras.push_back(rig->cameras[*place]);
        scene.sights.emplace_back(*film, rig->cameras[*place].lens);
    }
    return scene;
}

Expected<capture::MotionSync> synced(const MovingScene& scene,
                                     const std::vector<capture::Clock>& start) {
    return capture::sync_by_motion(scene.rig, scene.sights, start, scene.options);
}

// When the films were recorded, as they say it themselves.
std::vector<std::optional<double>> dates_of(const CapturePlan& plan) {
    std::vector<std::optional<double>> dates;
    for (const PlannedCamera& camera : plan.cameras) {
        const auto film = camera.film.empty()
                              ? fail(camera.name)
                              : open_film({camera.name, plan.file(camera.film), 0, 0}, {});
        dates.push_back(film ? (*film)->info().recorded : std::nullopt);
    }
    return dates;
}

const capture::Clock* clock_named(const std::vector<capture::Clock>& clocks,
                                  const std::string& camera) {
    const auto found = std::find_if(clocks.begin(), clocks.end(), [&camera](const auto& clock) {
        return clock.camera == camera;
    });
    return found == clocks.end() ? nullptr : &*found;
}

bool has_keypoints(const CapturePlan& plan) {
    return plan.cameras.size() >= 2 &&
           std::all_of(plan.cameras.begin(), plan.cameras.end(), [&](const PlannedCamera& camera) {
               return is_there(keypoint_file(plan, camera.name));
           });
}

// Those that were heard stay, and the others follow the first of them.
void keep_heard(const std::vector<capture::Clock>& heard, std::vector<capture::Clock>& clocks) {
    double moved = 0.0;
    for (const capture::Clock& clock : clocks) {
        if (const capture::Clock* const known = clock_named(heard, clock.camera)) {
            moved = known->offset - clock.offset;
            break;
        }
    }
    for (capture::Clock& clock : clocks) {
        const capture::Clock* const known = clock_named(heard, clock.camera);
        clock.offset += moved;
        clock = known != nullptr ? *known : clock;
    }
}

Expected<MotionClocks> clocks_by_joints(const CapturePlan& plan,
                                        const std::vector<capture::Clock>& heard,
                                        double within) {
    const auto films = load_keypoints(plan);
    if (!films) {
        return fail(films.error());
    }
    auto rough = capture::rough_clocks(*films, {within, dates_of(plan)});
    if (!rough) {
        return fail(std::move(rough.error()));
    }
    std::vector<capture::Clock>& clocks = rough->clocks;
    keep_heard(heard, clocks);
    const auto scene = scene_of_joints(plan, *films, clocks);
    const auto better = scene ? synced(*scene, clocks) : fail(scene.error());
    if (!better) {
        return fail(better.error());
    }
    for (std::size_t i = 0; i < clocks.size(); ++i) {
        if (clock_named(heard, clocks[i].camera) == nullptr) {
            const double confidence = clocks[i].confidence;
            clocks[i] = better->clocks[i];
            clocks[i].confidence = confidence;
        }
    }
    return MotionClocks{std::move(clocks), std::move(rough->doubts), std::move(rough->notes), 0.01};
}

Expected<MotionClocks> clocks_by_spots(const CapturePlan& plan,
                                       const std::vector<capture::Clock>& heard,
                                       double within) {
    constexpr double kFarthest = 10.0;  // seconds that cameras may be apart
    auto scene = scene_of_spots(plan);
    if (!scene) {
        return fail(std::move(scene.error()));
    }
    std::vector<capture::Clock> start;
    for (const PlannedCamera& camera : plan.cameras) {
        start.push_back({camera.name, 0.0, 0.0, 1.0});
    }
    keep_heard(heard, start);
    scene->options.reach = std::min(within, kFarthest);
    auto found = synced(*scene, start);
    if (!found) {
        return fail(std::move(found.error()));
    }
    MotionClocks clocks{std::move(found->clocks), {}, {}, 0.002};
    for (const capture::ClockRival& rival : found->rivals) {
        clocks.doubts.push_back(fmt::format(
            "{}: the dance repeats itself, and its clock fits at {:.2f} s and {:.2f} s nearly "
            "alike; the first is taken. Compare the films, and set it by hand where it is the "
            "other (raks capture sync --offsets), or say --within",
            start[rival.camera].camera,
            rival.taken,
            rival.other));
    }
    constexpr double kMostMiss = 4.0;  // pixels that spots are off where all is right
    if (found->distance > kMostMiss) {
        clocks.doubts.push_back(fmt::format(
            "by what moves: the markers of two cameras are {:.0f} pixels off each "
            "other's lines: were the cameras started within {:.0f} s, and do they stand "
            "as they were calibrated?",
            found->distance,
            scene->options.reach));
    }
    keep_heard(heard, clocks.clocks);
    return clocks;
}

}  // namespace

bool has_motion(const CapturePlan& plan) {
    const bool has_spots =
        is_there(plan.file("detections.csv")) || is_there(plan.file("labels.tsv"));
    return has_keypoints(plan) || (plan.cameras.size() >= 2 && !plan.is_markerless && has_spots &&
                                   is_there(plan.file("rig.toml")));
}

Expected<MotionClocks> clocks_by_motion(const CapturePlan& plan,
                                        const std::vector<capture::Clock>& heard,
                                        double within) {
    return has_keypoints(plan) ? clocks_by_joints(plan, heard, within)
                               : clocks_by_spots(plan, heard, within);
}

std::vector<std::string> check_by_motion(const CapturePlan& plan,
                                         const std::vector<capture::Clock>& heard) {
    std::vector<capture::Clock> start;
    for (const PlannedCamera& camera : plan.cameras) {
        if (const capture::Clock* const known = clock_named(heard, camera.name)) {
            start.push_back(*known);
        }
    }
    if (start.size() != plan.cameras.size()) {
        return {};
    }
    const auto scene = [&]() -> Expected<MovingScene> {
        if (!has_keypoints(plan)) {
            return scene_of_spots(plan);
        }
        const auto films = load_keypoints(plan);
        return films ? scene_of_joints(plan, *films, start) : fail(films.error());
    }();
    const auto moved = scene ? synced(*scene, start) : fail(scene.error());
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
