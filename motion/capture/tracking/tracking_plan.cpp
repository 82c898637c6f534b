#include "motion/capture/tracking/tracking_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "base/printable.hpp"
#include "motion/capture/tracking/view_order.hpp"

namespace raks::capture {
namespace {

Expected<Films> films_of(const TrackerInput& input) {
    Films films;
    for (const SeenFilm& film : input.seen.films) {
        const auto camera = input.rig.index_of(film.camera);
        if (!camera) {
            return fail(fmt::format("camera \"{}\" was filmed with but is not in the rig",
                                    printable(film.camera)));
        }
        const auto clock = std::find_if(input.clocks.begin(),
                                        input.clocks.end(),
                                        [&](const auto& c) { return c.camera == film.camera; });
        if (clock == input.clocks.end()) {
            return fail(fmt::format("camera \"{}\" has no clock; run raks capture sync first",
                                    printable(film.camera)));
        }
        films.cameras.push_back(*camera);
        films.clocks.push_back(*clock);
    }
    return films;
}

Expected<TimeLine> time_line_of(const TrackerInput& input,
                                const Films& films,
                                const TrackerOptions& options) {
    std::vector<double> starts;
    std::vector<double> ends;
    for (std::size_t i = 0; i < input.seen.films.size(); ++i) {
        const auto& pictures = input.seen.films[i].pictures;
        if (!pictures.empty()) {
            starts.push_back(films.clocks[i].capture_time(pictures.front().time));
            ends.push_back(films.clocks[i].capture_time(pictures.back().time));
        }
    }
    if (starts.size() < 2) {
        return fail("fewer than two films have pictures");
    }
    std::sort(starts.begin(), starts.end());
    std::sort(ends.begin(), ends.end(), std::greater<>());
    const double first = options.first_time.value_or(starts[1]);
    const double frames = (ends[1] - first) * options.frames_per_second;
    constexpr double kMostFrames = 1e7;
    if (!(frames >= 1.0 && frames < kMostFrames)) {
        return fail("the films share no moment; are their clocks right (raks capture sync)?");
    }
    // Rounded, so that a last picture that comes a little early still counts.
    return TimeLine{
        first, static_cast<std::size_t>(std::floor(frames + 0.5)) + 1, options.frames_per_second};
}

// The world is as large as the dancer says, by the places that are labelled first.
Expected<void> check_scale(const std::vector<glm::dvec3>& places,
                           const std::vector<DistanceLimit>& limits,
                           double height) {
    const double most = height > 0.0 ? 1.25 : 1.6;  // dancers differ, and where markers sit
    const double factor = scale_of(places, limits).value_or(1.0);
    if (factor < most && factor > 1.0 / most) {
        return {};
    }
    constexpr double kMillimetres = 300.0;  // and more: not a board, but another unit
    if (factor > kMillimetres) {
        return fail(
            "the labelled markers are hundreds of metres apart: is the rig in millimetres (raks "
            "capture calibrate FOLDER --rig FILE --unit mm)?");
    }
    return fail(fmt::format(
        "the labelled markers are {:.3g} times as far apart as on a dancer{}: measure the board's "
        "square, in metres; {:.3g} times what capture.toml says would fit; then calibrate again",
        factor,
        height > 0.0 ? fmt::format(" of {:.2f} m", height) : "",
        1.0 / factor));
}

// Limits of the body, by the first frame in which markers are labelled.
Expected<std::vector<DistanceLimit>> limits_of(const TrackerInput& input,
                                               const TrackRunInput& run,
                                               double height) {
    std::vector<DistanceLimit> limits = distance_limits(input.markers, height);
    std::vector<glm::dvec3> places(input.markers.markers.size(),
                                   glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t marker = 0; marker < places.size(); ++marker) {
        std::vector<PointView> views;
        for (const SaidView& said : run.said) {
            if (said.marker == marker && (views.empty() || said.frame == run.said.front().frame)) {
                views.push_back(
                    {said.camera, direction_of(input.rig.cameras[said.camera].lens, said.pixel)});
            }
        }
        if (const auto point = triangulate(input.rig, views, run.sigma)) {
            places[marker] = point->place;
        }
    }
    if (auto checked = check_scale(places, limits, height); !checked) {
        return fail(std::move(checked.error()));
    }
    narrow_to(places, limits);
    return limits;
}

Expected<void> check_labels(const TrackerInput& input, const TrackRunInput& run) {
    for (std::size_t marker = 0; marker < input.markers.markers.size(); ++marker) {
        std::vector<std::pair<std::size_t, std::size_t>> views;
        bool is_placed = false;
        for (const SaidView& said : run.said) {
            if (said.marker != marker) {
                continue;
            }
            is_placed =
                is_placed || std::any_of(views.begin(), views.end(), [&](const auto& other) {
                    return other.first == said.frame && other.second != said.camera;
                });
            views.emplace_back(said.frame, said.camera);
        }
        if (is_placed) {
            return {};
        }
    }
    return fail("no marker is labelled in two cameras at one moment; run raks capture label");
}

// By colour of the observations: its class of the markers; none: no marker has it.
std::vector<std::optional<std::size_t>> classes_of(const TrackerInput& input) {
    const std::vector<std::string> known = input.markers.colours();
    std::vector<std::optional<std::size_t>> classes;
    for (const std::string& colour : input.seen.colours) {
        const auto found = std::find(known.begin(), known.end(), colour);
        classes.push_back(found != known.end()
                              ? std::optional(static_cast<std::size_t>(found - known.begin()))
                              : std::nullopt);
    }
    return classes;
}

}  // namespace

FrameViews TrackingPlan::all_views() const {
    return {input->rig,
            input->seen,
            films.cameras,
            films.clocks,
            classes,
            line.first,
            line.frames_per_second,
            line.frame_count};
}

Tracks TrackingPlan::empty_tracks() const {
    Tracks tracks;
    for (const Marker& marker : input->markers.markers) {
        tracks.markers.push_back(marker.name);
    }
    tracks.frames_per_second = line.frames_per_second;
    tracks.first_time = line.first;
    tracks.frame_count = line.frame_count;
    tracks.places.resize(line.frame_count * tracks.markers.size());
    return tracks;
}

Expected<TrackingPlan> plan_tracking(const TrackerInput& input,
                                     const TrackerOptions& options,
                                     LabelNeed labels) {
    if (auto checked = check_rig(input.rig); !checked) {
        return fail(std::move(checked.error()));
    }
    auto films = films_of(input);
    const auto line = films ? time_line_of(input, *films, options) : fail(films.error());
    if (!line) {
        return fail(line.error());
    }
    TrackingPlan plan{&input, std::move(*films), *line, {}, classes_of(input)};
    TrackRunInput& run = plan.run;
    run.rig = &input.rig;
    run.classes = input.markers.classes();
    run.seconds = 1.0 / options.frames_per_second;
    run.sigma = options.sigma;
    run.acceleration = options.acceleration;
    if (auto read = read_said(input, plan.films, plan.line, run); !read) {
        return fail(std::move(read.error()));
    }
    if (labels == LabelNeed::needed) {
        if (auto checked = check_labels(input, run); !checked) {
            return fail(std::move(checked.error()));
        }
    }
    auto limits = limits_of(input, run, options.height);
    if (!limits) {
        return fail(std::move(limits.error()));
    }
    run.limits = std::move(*limits);
    if (options.check_order) {
        FrameViews views = plan.all_views();
        if (auto checked =
                check_view_order(input.rig, views, line->frame_count, run.said, options.sigma);
            !checked) {
            return fail(std::move(checked.error()));
        }
    }
    return plan;
}

}  // namespace raks::capture
