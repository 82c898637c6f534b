#include "apps/raks_capture/keypoint_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"

namespace raks::apps {
namespace {

constexpr double kMostRate = 60.0;  // frames a second that keypoints are worth

// Pictures a second of the fastest film, by the middle of the steps between them.
double rate_of(const std::vector<capture::KeypointFilm>& films) {
    double fastest = 1.0;
    for (const capture::KeypointFilm& film : films) {
        std::vector<double> steps;
        for (std::size_t i = 1; i < film.pictures.size(); ++i) {
            steps.push_back(film.pictures[i].time - film.pictures[i - 1].time);
        }
        if (!steps.empty()) {
            const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
            std::nth_element(steps.begin(), middle, steps.end());
            fastest = std::max(fastest, 1.0 / *middle);
        }
    }
    return std::min(fastest, kMostRate);
}

Expected<std::vector<capture::Clock>> clocks_of(const CapturePlan& plan) {
    std::vector<capture::Clock> clocks;
    if (!is_there(plan.file("clocks.toml"))) {
        say("no clocks.toml: all films are taken to begin at the same moment (raks capture sync)");
        for (const PlannedCamera& camera : plan.cameras) {
            clocks.push_back({camera.name, 0.0, 0.0, 0.0});
        }
        return clocks;
    }
    const auto read = load_clocks(plan);
    if (!read) {
        return fail(read.error());
    }
    for (const PlannedCamera& camera : plan.cameras) {
        const auto clock =
            std::find_if(read->begin(), read->end(), [&camera](const capture::Clock& other) {
                return other.camera == camera.name;
            });
        if (clock == read->end()) {
            return fail(
                fmt::format("{}: camera {} has no clock: run raks capture sync again, or set it by "
                            "hand (--offsets)",
                            plan.file("clocks.toml").string(),
                            camera.name));
        }
        clocks.push_back(*clock);
    }
    return clocks;
}

}  // namespace

Expected<SeenDancer> load_keypoint_take(const CapturePlan& plan) {
    if (plan.cameras.size() < 2) {
        return fail(plan.folder.string() +
                    ": one camera is too few: a second one, 70 to 100 degrees to its side, tells "
                    "how far away things are");
    }
    SeenDancer seen;
    auto films = load_keypoints(plan);
    if (!films) {
        return fail(std::move(films.error()));
    }
    seen.films = std::move(*films);
    auto clocks = clocks_of(plan);
    if (!clocks) {
        return fail(std::move(clocks.error()));
    }
    seen.clocks = std::move(*clocks);
    auto take = capture::keypoint_take(seen.films, seen.clocks, rate_of(seen.films));
    if (!take) {
        return fail(std::move(take.error()).in(plan.folder.string()));
    }
    seen.take = std::move(*take);
    return seen;
}

Expected<capture::Rig> load_rig_in_order(const CapturePlan& plan) {
    const auto rig = load_capture_rig(plan);
    if (!rig) {
        return fail(rig.error());
    }
    capture::Rig ordered;
    ordered.floor = rig->floor;
    for (const PlannedCamera& camera : plan.cameras) {
        const auto index = rig->index_of(camera.name);
        if (!index) {
            return fail(fmt::format("{}: lacks camera {}; run raks capture calibrate {} --dancer",
                                    plan.file("rig.toml").string(),
                                    camera.name,
                                    plan.folder.string()));
        }
        ordered.cameras.push_back(rig->cameras[*index]);
    }
    return ordered;
}

bool is_of_keypoints(const capture::Tracks& tracks) {
    return std::all_of(tracks.markers.begin(), tracks.markers.end(), [](const std::string& name) {
        return capture::body_point_named(name).has_value();
    });
}

Expected<capture::MarkerSet> markers_of(const CapturePlan& plan, const capture::Tracks& tracks) {
    return is_of_keypoints(tracks) ? Expected<capture::MarkerSet>(capture::network_markers())
                                   : load_markers(plan);
}

}  // namespace raks::apps
