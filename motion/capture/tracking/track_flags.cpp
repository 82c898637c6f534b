#include "motion/capture/tracking/track_flags.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kLongestFilled = 0.5;     // seconds
constexpr double kLongestUnflagged = 0.2;  // seconds
constexpr double kNearEnoughToSwap = 0.1;  // metres
constexpr double kLargeResidual = 3.0;     // sigma

/// What was tracked, by frame and marker.
class Tracked {
 public:
    Tracked(const std::vector<TrackedMarker>& tracked, std::size_t markers)
        : tracked_(tracked), markers_(markers) {}
    [[nodiscard]] const TrackedMarker& at(std::size_t frame, std::size_t marker) const {
        return tracked_[frame * markers_ + marker];
    }
    [[nodiscard]] std::size_t frames() const { return tracked_.size() / markers_; }

 private:
    const std::vector<TrackedMarker>& tracked_;
    std::size_t markers_;
};

bool is_seen(const TrackedMarker& marker) { return marker.measured && !marker.is_of_body; }

// Smooths one marker's run of frames, whose first and last were measured.
void smooth_run(const Tracked& tracked,
                std::size_t marker,
                std::size_t first,
                std::size_t last,
                const TrackRunInput& run,
                double smoothing,
                Tracks& tracks) {
    std::vector<std::optional<MeasuredPlace>> measured;
    for (std::size_t frame = first; frame <= last; ++frame) {
        measured.push_back(tracked.at(frame, marker).measured);
    }
    const auto beliefs = smoothed(measured, run.seconds, smoothing);
    for (std::size_t i = 0; i < beliefs.size(); ++i) {
        const TrackedMarker& seen = tracked.at(first + i, marker);
        tracks.at(first + i, marker) = {beliefs[i].place,
                                        beliefs[i].deviation(),
                                        static_cast<std::uint8_t>(seen.views),
                                        is_seen(seen) ? PlaceSource::seen : PlaceSource::filled};
    }
}

// Smooths a marker's track between the gaps that are too long to fill.
void smooth_marker(const Tracked& tracked,
                   std::size_t marker,
                   const TrackRunInput& run,
                   double smoothing,
                   Tracks& tracks) {
    std::size_t first = tracked.frames();
    std::size_t last = 0;
    for (std::size_t frame = 0; frame < tracked.frames(); ++frame) {
        if (!tracked.at(frame, marker).measured) {
            continue;
        }
        const bool is_far = first < tracked.frames() &&
                            static_cast<double>(frame - last) * run.seconds > kLongestFilled;
        if (is_far) {
            smooth_run(tracked, marker, first, last, run, smoothing, tracks);
        }
        first = first == tracked.frames() || is_far ? frame : first;
        last = frame;
    }
    if (first < tracked.frames()) {
        smooth_run(tracked, marker, first, last, run, smoothing, tracks);
    }
}

// Flags the stretches of a marker's frames of which `is_doubtful` is true and that are at least so
// long.
void flag_stretches(Tracks& tracks,
                    Doubt doubt,
                    std::size_t marker,
                    double least_seconds,
                    const std::function<bool(std::size_t)>& is_doubtful) {
    std::size_t first = 0;
    for (std::size_t frame = 0; frame <= tracks.frame_count; ++frame) {
        if (frame < tracks.frame_count && is_doubtful(frame)) {
            continue;
        }
        if (frame > first &&
            static_cast<double>(frame - first) / tracks.frames_per_second > least_seconds) {
            tracks.flags.push_back({doubt, marker, first, frame - 1});
        }
        first = frame + 1;
    }
}

// Whether a third of the markers was missed at once: then a film jumped, or the dancer did.
bool is_filled_for_many(const Tracks& tracks, std::size_t frame) {
    std::size_t filled = 0;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        filled += tracks.at(frame, marker).source == PlaceSource::filled ? 1U : 0U;
    }
    return 3 * filled >= tracks.markers.size();
}

// Whether a marker is where the body cannot have it.
bool breaks_limits(const Tracks& tracks,
                   const std::vector<DistanceLimit>& limits,
                   std::size_t frame,
                   std::size_t marker) {
    return std::any_of(limits.begin(), limits.end(), [&](const DistanceLimit& limit) {
        if (limit.one != marker && limit.other != marker) {
            return false;
        }
        const double apart =
            glm::distance(tracks.at(frame, limit.one).place, tracks.at(frame, limit.other).place);
        return apart < limit.least || apart > limit.most;
    });
}

bool is_near_its_like(const Tracks& tracks,
                      const std::vector<std::size_t>& classes,
                      std::size_t frame,
                      std::size_t marker) {
    for (std::size_t other = 0; other < classes.size(); ++other) {
        if (other != marker && classes[other] == classes[marker] &&
            glm::distance(tracks.at(frame, other).place, tracks.at(frame, marker).place) <
                kNearEnoughToSwap) {
            return true;
        }
    }
    return false;
}

// Whether a marker's views do not agree, or it jumped a few frames before or after.
bool is_odd(const Tracked& tracked, double sigma, std::size_t frame, std::size_t marker) {
    constexpr std::size_t kAround = 4;  // frames that a jump spoils
    if (tracked.at(frame, marker).residual > kLargeResidual * sigma) {
        return true;
    }
    const std::size_t first = frame > kAround ? frame - kAround : 0;
    const std::size_t last = std::min(frame + kAround, tracked.frames() - 1);
    for (std::size_t near = first; near <= last; ++near) {
        if (tracked.at(near, marker).jumps) {
            return true;
        }
    }
    return false;
}

void flag(const Tracked& tracked, const TrackRunInput& run, Tracks& tracks) {
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        const auto source = [&](std::size_t frame) { return tracks.at(frame, marker).source; };
        flag_stretches(tracks, Doubt::lost, marker, 0.0, [&](std::size_t frame) {
            return source(frame) == PlaceSource::lost;
        });
        flag_stretches(tracks, Doubt::filled, marker, kLongestUnflagged, [&](std::size_t frame) {
            return source(frame) == PlaceSource::filled;
        });
        flag_stretches(tracks, Doubt::filled, marker, 0.0, [&](std::size_t frame) {
            return source(frame) == PlaceSource::filled && is_filled_for_many(tracks, frame);
        });
        flag_stretches(tracks, Doubt::length, marker, 0.0, [&](std::size_t frame) {
            return tracked.at(frame, marker).contradicts ||
                   breaks_limits(tracks, run.limits, frame, marker);
        });
        flag_stretches(tracks, Doubt::exchanged, marker, 0.0, [&](std::size_t frame) {
            return is_near_its_like(tracks, run.classes, frame, marker);
        });
        flag_stretches(tracks, Doubt::residual, marker, 0.0, [&](std::size_t frame) {
            return is_odd(tracked, run.sigma, frame, marker);
        });
    }
    sort_flags(tracks);
}

}  // namespace

void fill_stages(const std::vector<TrackedMarker>& tracked,
                 const TrackRunInput& run,
                 double smoothing,
                 Tracks& triangulated,
                 Tracks& filtered,
                 Tracks& smoothed) {
    const std::size_t markers = run.classes.size();
    const Tracked by_frame(tracked, markers);
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        const TrackedMarker& marker = tracked[i];
        const auto views = static_cast<std::uint8_t>(marker.views);
        if (marker.measured) {
            const glm::dmat3& c = marker.measured->covariance;
            triangulated.places[i] = {marker.measured->place,
                                      std::sqrt(c[0][0] + c[1][1] + c[2][2]),
                                      views,
                                      is_seen(marker) ? PlaceSource::seen : PlaceSource::filled};
        }
        if (marker.belief) {
            filtered.places[i] = {marker.belief->place,
                                  marker.belief->deviation(),
                                  views,
                                  is_seen(marker) ? PlaceSource::seen : PlaceSource::filled};
        }
    }
    for (std::size_t marker = 0; marker < markers; ++marker) {
        smooth_marker(by_frame, marker, run, smoothing, smoothed);
    }
    flag(by_frame, run, smoothed);
}

}  // namespace raks::capture
