#include "motion/capture/tracking/marker_tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/printable.hpp"
#include "motion/capture/tracking/track_flags.hpp"
#include "motion/capture/tracking/track_run.hpp"
#include "motion/capture/tracking/view_order.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// The films in order of the input, as the tracker uses them.
struct Films {
    std::vector<std::size_t> cameras;  ///< by film: its camera in the rig
    std::vector<Clock> clocks;         ///< by film
};

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

/// The moments that two or more films cover.
struct TimeLine {
    double first = 0.0;
    std::size_t frame_count = 0;
};

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
    return TimeLine{first, static_cast<std::size_t>(std::floor(frames + 0.5)) + 1};
}

/// What a person said, for the run.
class SaidReader {
 public:
    SaidReader(const TrackerInput& input,
               const Films& films,
               const TimeLine& line,
               double frames_per_second,
               TrackRunInput& run)
        : input_(input), films_(films), line_(line), rate_(frames_per_second), run_(run) {}

    Expected<void> read() {
        for (const MarkerLabel& label : input_.labels) {
            if (auto done = add_label(label); !done) {
                return done;
            }
        }
        for (const Edit& edit : input_.edits) {
            if (auto done = add_edit(edit); !done) {
                return done;
            }
        }
        return {};
    }

 private:
    [[nodiscard]] Expected<std::size_t> marker_called(const std::string& name) const {
        const auto marker = input_.markers.index_of(name);
        return marker
                   ? Expected<std::size_t>(*marker)
                   : fail(fmt::format("marker \"{}\" is not in the marker set", printable(name)));
    }

    [[nodiscard]] Expected<std::size_t> film_of(const std::string& camera) const {
        for (std::size_t i = 0; i < input_.seen.films.size(); ++i) {
            if (input_.seen.films[i].camera == camera) {
                return i;
            }
        }
        return fail(fmt::format("camera \"{}\" has no film", printable(camera)));
    }

    [[nodiscard]] Expected<void> check_pixel(std::size_t film, const glm::dvec2& pixel) const {
        const Camera& camera = input_.rig.cameras[films_.cameras[film]];
        if (is_in_picture(camera.lens, pixel)) {
            return {};
        }
        return fail(
            fmt::format("({:.1f}, {:.1f}) lies outside of the {} x {} picture of camera "
                        "\"{}\"",
                        pixel.x,
                        pixel.y,
                        camera.lens.width,
                        camera.lens.height,
                        printable(camera.name)));
    }

    Expected<void> add_label(const MarkerLabel& label) {
        const auto marker = marker_called(label.marker);
        const auto film = film_of(label.camera);
        if (!marker || !film) {
            return fail(marker ? film.error() : marker.error());
        }
        const auto& pictures = input_.seen.films[*film].pictures;
        if (label.picture >= pictures.size()) {
            return fail(fmt::format("a label is in picture {} of camera \"{}\", which has {}",
                                    label.picture,
                                    printable(label.camera),
                                    pictures.size()));
        }
        const double time = films_.clocks[*film].capture_time(pictures[label.picture].time);
        const double frame = std::round((time - line_.first) * rate_);
        if (frame < 0.0 || frame >= static_cast<double>(line_.frame_count)) {
            return {};  // before the time line begins
        }
        run_.said.push_back({static_cast<std::size_t>(frame),
                             films_.cameras[*film],
                             *marker,
                             label.pixel,
                             time - line_.first - frame / rate_});
        return check_pixel(*film, label.pixel);
    }

    Expected<void> add_edit(const Edit& edit) {
        const auto marker = marker_called(edit.marker);
        if (!marker) {
            return fail(marker.error());
        }
        switch (edit.kind) {
            case EditKind::set:
                return add_set(edit, *marker);
            case EditKind::hide:
            case EditKind::fill:
                run_.hidden.push_back({*marker, edit.first, edit.last});
                return {};
            case EditKind::swap:
                break;
        }
        const auto other = marker_called(edit.other);
        if (!other) {
            return fail(other.error());
        }
        run_.swaps.push_back({edit.first, *marker, *other});
        return {};
    }

    Expected<void> add_set(const Edit& edit, std::size_t marker) {
        const auto film = film_of(edit.camera);
        if (!film) {
            return fail(film.error());
        }
        // By the picture of that camera that is nearest to the frame.
        const double time = line_.first + static_cast<double>(edit.first) / rate_;
        double late = std::numeric_limits<double>::infinity();
        for (const SeenPicture& picture : input_.seen.films[*film].pictures) {
            const double other = films_.clocks[*film].capture_time(picture.time) - time;
            late = std::abs(other) < std::abs(late) ? other : late;
        }
        run_.said.push_back({edit.first,
                             films_.cameras[*film],
                             marker,
                             edit.pixel,
                             std::isfinite(late) ? late : 0.0});
        return check_pixel(*film, edit.pixel);
    }

    const TrackerInput& input_;
    const Films& films_;
    const TimeLine& line_;
    double rate_;
    TrackRunInput& run_;
};

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

Tracks empty_tracks(const TrackerInput& input, const TimeLine& line, double rate) {
    Tracks tracks;
    for (const Marker& marker : input.markers.markers) {
        tracks.markers.push_back(marker.name);
    }
    tracks.frames_per_second = rate;
    tracks.first_time = line.first;
    tracks.frame_count = line.frame_count;
    tracks.places.resize(line.frame_count * tracks.markers.size());
    return tracks;
}

/// What was followed, and what of the cameras did not count.
struct Followed {
    std::vector<TrackedMarker> tracked;
    std::vector<CameraMove> moves;
};

// Forgets what cameras saw while they disagree, what a person said of it included.
void forget_moves(const std::vector<CameraMove>& moves, TrackRunInput& run, FrameViews& views) {
    for (const CameraMove& move : moves) {
        const std::size_t camera = *run.rig->index_of(move.camera);
        views.forget(camera, move.first, move.last);
        std::erase_if(run.said, [&](const SaidView& said) {
            return said.camera == camera && said.frame >= move.first && said.frame <= move.last;
        });
    }
}

// Follows the markers; as long as a camera disagrees, again without it. Two cameras stay. Against
// markers that were followed without it, a camera must disagree still, or it was the others' fault.
Followed follow_what_agrees(const TrackRunInput& input,
                            const std::function<FrameViews()>& all_views,
                            std::size_t frame_count) {
    FrameViews views = all_views();
    Followed followed{run_tracker(input, views, frame_count), {}};
    for (std::size_t left = input.rig->cameras.size(); left > 2; --left) {
        TrackRunInput run = input;
        FrameViews fewer = all_views();
        forget_moves(followed.moves, run, fewer);
        const auto found = find_moved_camera(run, fewer, followed.tracked);
        if (found.empty()) {
            break;
        }
        forget_moves(found, run, fewer);
        auto tracked = run_tracker(run, fewer, frame_count);
        FrameViews whole = all_views();
        forget_moves(followed.moves, run, whole);
        const auto again = find_moved_camera(run, whole, tracked);
        if (again.empty() || again.front().camera != found.front().camera) {
            break;
        }
        followed.tracked = std::move(tracked);
        followed.moves.insert(followed.moves.end(), found.begin(), found.end());
    }
    return followed;
}

}  // namespace

Expected<TrackerStages> track_markers(const TrackerInput& input, const TrackerOptions& options) {
    if (auto checked = check_rig(input.rig); !checked) {
        return fail(std::move(checked.error()));
    }
    const auto films = films_of(input);
    const auto line = films ? time_line_of(input, *films, options) : fail(films.error());
    if (!line) {
        return fail(line.error());
    }
    TrackRunInput run;
    run.rig = &input.rig;
    run.classes = input.markers.classes();
    run.seconds = 1.0 / options.frames_per_second;
    run.sigma = options.sigma;
    run.acceleration = options.acceleration;
    SaidReader said(input, *films, *line, options.frames_per_second, run);
    if (auto read = said.read(); !read) {
        return fail(std::move(read.error()));
    }
    if (auto checked = check_labels(input, run); !checked) {
        return fail(std::move(checked.error()));
    }
    auto limits = limits_of(input, run, options.height);
    if (!limits) {
        return fail(std::move(limits.error()));
    }
    run.limits = std::move(*limits);
    const std::vector<std::optional<std::size_t>> classes = classes_of(input);
    const auto all_views = [&] {
        return FrameViews(input.rig,
                          input.seen,
                          films->cameras,
                          films->clocks,
                          classes,
                          line->first,
                          options.frames_per_second,
                          line->frame_count);
    };
    if (options.check_order) {
        FrameViews views = all_views();
        if (auto checked =
                check_view_order(input.rig, views, line->frame_count, run.said, options.sigma);
            !checked) {
            return fail(std::move(checked.error()));
        }
    }
    const Followed followed = follow_what_agrees(run, all_views, line->frame_count);
    const std::vector<TrackedMarker>& tracked = followed.tracked;
    const Tracks empty = empty_tracks(input, *line, options.frames_per_second);
    TrackerStages stages{empty, empty, empty, followed.moves};
    fill_stages(
        tracked, run, options.smoothing, stages.triangulated, stages.filtered, stages.smoothed);
    return stages;
}

}  // namespace raks::capture
