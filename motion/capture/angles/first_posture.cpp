#include "motion/capture/angles/first_posture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/solving/frame_fit.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kPostureDegree = M_PI / 180.0;
constexpr double kLabelDeviation = 0.01;  // metres
constexpr double kElsewhere = 0.15;       // metres: markers may sit so far from where the set says
constexpr double kOffTheBody = 0.2;       // metres
// Without limits the markers come this much nearer to their labels (half of a weighted sum of
// squares: one marker by 6 cm), and a joint is so far beyond its own.
constexpr double kMuchNearer = 20.0;
constexpr double kFarBeyondLimits = 10.0 * kPostureDegree;

FrameSight labelled_sight(const TrackRunInput& input, std::size_t frame) {
    FrameSight sight;
    for (std::size_t marker = 0; marker < input.classes.size(); ++marker) {
        std::vector<PointView> views;
        for (const SaidView& said : input.said) {
            if (said.frame == frame && said.marker == marker) {
                views.push_back(
                    {said.camera, direction_of(input.rig->cameras[said.camera].lens, said.pixel)});
            }
        }
        if (const auto point = triangulate(*input.rig, views, input.sigma)) {
            sight.markers.push_back({marker, point->place, kLabelDeviation});
        }
    }
    return sight;
}

std::optional<std::pair<std::size_t, FrameSight>> best_labels(const FrameContext& context,
                                                              const TrackRunInput& input) {
    std::vector<std::size_t> frames;
    for (const SaidView& said : input.said) {
        frames.push_back(said.frame);
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    std::pair<std::size_t, FrameSight> best;
    for (const std::size_t frame : frames) {
        FrameSight sight = labelled_sight(input, frame);
        if (sight.markers.size() > best.second.markers.size()) {
            best = {frame, std::move(sight)};
        }
    }
    const auto of_trunk = std::count_if(
        best.second.markers.begin(), best.second.markers.end(), [&](const SeenMarker& seen) {
            return is_of_trunk(context.marker_bones[seen.marker]);
        });
    return of_trunk >= 3 ? std::optional(std::move(best)) : std::nullopt;
}

Expected<void> check_on_body(const FrameContext& context,
                             const FrameSight& sight,
                             const BodyState& state) {
    const auto places = marker_places_of(context, state);
    std::size_t off = 0;
    for (const SeenMarker& seen : sight.markers) {
        off += glm::distance(places[seen.marker], seen.place) > kOffTheBody ? 1U : 0U;
    }
    if (4 * off < sight.markers.size()) {
        return {};
    }
    return fail(fmt::format(
        "{} of the {} labelled markers are not on the body: they are {:.0f} cm or more from where "
        "it can have them; are they labelled right, and is markers.toml as the dancer wears them?",
        off,
        sight.markers.size(),
        100.0 * kOffTheBody));
}

// How far a joint is beyond its limits; radians.
double beyond_limits(const BodyModel& model, const BodyState& state, std::size_t index) {
    const TurningJoint& joint = model.joints()[index];
    const double at = model.from_usual(state, index);
    return joint.is_hinge ? std::max(joint.lowest - at, at - joint.highest) : at - joint.highest;
}

// `unlimited`: the posture without limits, from which the first one differs.
Expected<void> check_first_limits(const FrameContext& wide,
                                  const FittedFrame& first,
                                  const FittedFrame& unlimited) {
    if (first.cost - unlimited.cost < kMuchNearer) {
        return {};
    }
    std::size_t worst = 0;
    double most = kFarBeyondLimits;
    for (std::size_t i = 1; i < wide.model.joints().size(); ++i) {
        const double beyond = beyond_limits(wide.model, unlimited.state, i);
        if (beyond > most) {
            worst = i;
            most = beyond;
        }
    }
    if (worst == 0) {
        return {};
    }
    const TurningJoint& joint = wide.model.joints()[worst];
    const double at = wide.model.from_usual(unlimited.state, worst);
    return fail(fmt::format(
        "the limits exclude the first posture: joint {} is at {:.0f} degrees there, may be "
        "{}{:.0f}; widen them in the body's file, or look at the labels",
        joint.name,
        at / kPostureDegree,
        joint.is_hinge ? fmt::format("{:.0f} to ", joint.lowest / kPostureDegree) : "up to ",
        joint.highest / kPostureDegree));
}

}  // namespace

Expected<std::optional<FirstPosture>> posture_by_labels(const FrameContext& context,
                                                        const TrackRunInput& input) {
    auto labels = best_labels(context, input);
    if (!labels) {
        return std::optional<FirstPosture>();
    }
    FrameContext wide = context;
    wide.weights.outlier = kElsewhere;
    const FittedFrame found =
        find_frame(wide, labels->second, context.model.usual_state(context.shape));
    constexpr int kMoreSteps = 30;
    const BodyModel free_model = context.model.without_limits();
    const FrameContext free{free_model, wide.marker_bones, wide.shape, wide.weights};
    const FittedFrame unlimited = fit_frame(free, labels->second, found.state, kMoreSteps);
    if (auto checked = check_on_body(context, labels->second, unlimited.state); !checked) {
        return fail(std::move(checked.error()));
    }
    if (auto checked = check_first_limits(wide, found, unlimited); !checked) {
        return fail(std::move(checked.error()));
    }
    return std::optional(FirstPosture{labels->first, found.state});
}

}  // namespace raks::capture
