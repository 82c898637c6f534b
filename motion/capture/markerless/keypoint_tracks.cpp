#include "motion/capture/markerless/keypoint_tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "motion/capture/markerless/away_frames.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/triangulation/triangulation.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kMostResidual = 4.0;      // usual errors
constexpr double kLongestUnflagged = 0.2;  // seconds
constexpr double kLongestContradiction = 0.1;

// The middle of the trunk's joints at a frame; none: fewer than three are placed.
std::optional<glm::dvec3> trunk_at(const Tracks& tracks, std::size_t frame) {
    constexpr std::array<BodyPoint, 4> kTrunk = {BodyPoint::left_shoulder,
                                                 BodyPoint::right_shoulder,
                                                 BodyPoint::left_hip,
                                                 BodyPoint::right_hip};
    const auto points = followed_points();
    glm::dvec3 sum{};
    double count = 0.0;
    for (std::size_t marker = 0; marker < points.size(); ++marker) {
        const MarkerPlace& place = tracks.at(frame, marker);
        const bool is_of_trunk =
            std::find(kTrunk.begin(), kTrunk.end(), points[marker]) != kTrunk.end();
        if (is_of_trunk && place.source != PlaceSource::lost) {
            sum += place.place;
            count += 1.0;
        }
    }
    return count >= 3.0 ? std::optional(sum / count) : std::nullopt;
}

// Takes out the frames in which the body is where the dancer cannot have got to.
void drop_jumps(Tracks& tracks, std::vector<KeypointOutcome>& outcomes) {
    constexpr TrunkLimits kMetres{0.35, 2.5, 0.75};
    std::vector<std::optional<glm::dvec3>> trunks;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        trunks.push_back(trunk_at(tracks, frame));
    }
    const auto away = away_frames(trunks, tracks.frames_per_second, kMetres);
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        for (std::size_t marker = 0; away[frame] && marker < tracks.markers.size(); ++marker) {
            tracks.at(frame, marker) = {};
            outcomes[frame * tracks.markers.size() + marker] = KeypointOutcome::away;
        }
    }
}

void flag_stretches(Doubt doubt,
                    double least_seconds,
                    const std::function<bool(std::size_t, std::size_t)>& is_so,
                    Tracks& tracks) {
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        std::size_t first = 0;
        for (std::size_t frame = 0; frame <= tracks.frame_count; ++frame) {
            if (frame < tracks.frame_count && is_so(frame, marker)) {
                continue;
            }
            const double seconds = static_cast<double>(frame - first) / tracks.frames_per_second;
            if (frame > first && seconds >= least_seconds) {
                tracks.flags.push_back({doubt, marker, first, frame - 1});
            }
            first = frame + 1;
        }
    }
}

}  // namespace

PlacedKeypoint place_keypoint(const Rig& rig,
                              const KeypointTake& take,
                              std::size_t frame,
                              BodyPoint point,
                              const std::vector<double>& errors) {
    std::vector<PointView> views;
    double error = 0.0;
    for (std::size_t camera = 0; camera < take.cameras; ++camera) {
        const Keypoint& seen = take.point(frame, camera, point);
        if (seen.visibility >= kLeastVisibility && errors[camera] > 0.0) {
            views.push_back(
                {camera, direction_of(rig.cameras[camera].lens, seen.pixel), {}, seen.visibility});
            error += errors[camera];
        }
    }
    if (views.size() < 2) {
        return {};
    }
    error /= static_cast<double>(views.size());
    const auto placed = triangulate(rig, views, error);
    if (!placed || placed->residual > kMostResidual * error) {
        return {KeypointOutcome::contradicts, {}, {}};
    }
    PlacedKeypoint found;
    found.outcome = KeypointOutcome::placed;
    found.place.place = placed->place;
    found.place.deviation = placed->deviation();
    found.place.views = static_cast<std::uint8_t>(placed->views.size());
    found.place.source = PlaceSource::seen;
    for (std::size_t view = 0; view < views.size(); ++view) {
        if (std::find(placed->views.begin(), placed->views.end(), view) == placed->views.end()) {
            found.odd.push_back(views[view].camera);
        }
    }
    return found;
}

Tracks keypoint_tracks(const Rig& rig,
                       const KeypointTake& take,
                       const std::vector<double>& errors) {
    Tracks tracks;
    const auto points = followed_points();
    for (const BodyPoint point : points) {
        tracks.markers.emplace_back(name_of(point));
    }
    tracks.frames_per_second = take.frames_per_second;
    tracks.first_time = take.first_time;
    tracks.frame_count = take.frame_count;
    std::vector<KeypointOutcome> outcomes;
    for (std::size_t frame = 0; frame < take.frame_count; ++frame) {
        for (const BodyPoint point : points) {
            const PlacedKeypoint placed = place_keypoint(rig, take, frame, point, errors);
            tracks.places.push_back(placed.place);
            outcomes.push_back(placed.outcome);
        }
    }
    drop_jumps(tracks, outcomes);
    const auto outcome = [&](std::size_t frame, std::size_t marker) {
        return outcomes[frame * points.size() + marker];
    };
    flag_stretches(
        Doubt::residual,
        kLongestContradiction,
        [&](std::size_t frame, std::size_t marker) {
            return outcome(frame, marker) == KeypointOutcome::contradicts;
        },
        tracks);
    flag_stretches(
        Doubt::person,
        0.0,
        [&](std::size_t frame, std::size_t marker) {
            return marker == 0 && outcome(frame, marker) == KeypointOutcome::away;
        },
        tracks);
    flag_stretches(
        Doubt::lost,
        kLongestUnflagged,
        [&](std::size_t frame, std::size_t marker) {
            return outcome(frame, marker) == KeypointOutcome::unseen;
        },
        tracks);
    sort_flags(tracks);
    return tracks;
}

Tracks smoothed_tracks(const Tracks& tracks, double deviation) {
    Tracks smoothed = tracks;
    const double frames = deviation * tracks.frames_per_second;
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * frames));
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
            if (tracks.at(frame, marker).source == PlaceSource::lost) {
                continue;
            }
            glm::dvec3 sum{};
            double weights = 0.0;
            for (std::ptrdiff_t step = -reach; step <= reach; ++step) {
                const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(frame) + step;
                if (at < 0 || at >= static_cast<std::ptrdiff_t>(tracks.frame_count)) {
                    continue;
                }
                const MarkerPlace& place = tracks.at(static_cast<std::size_t>(at), marker);
                if (place.source != PlaceSource::lost) {
                    const double away = static_cast<double>(step) / frames;
                    const double weight = std::exp(-0.5 * away * away);
                    sum += weight * place.place;
                    weights += weight;
                }
            }
            smoothed.at(frame, marker).place = sum / weights;
        }
    }
    return smoothed;
}

}  // namespace raks::capture
