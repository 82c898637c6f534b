#include "motion/choreography/figure_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/choreography/joint_limits.hpp"
#include "motion/skeleton/body_capsules.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::array<std::string_view, 2> kFootNames = {"left foot", "right foot"};  // by Side

std::string_view name_of(Side side) { return kFootNames[static_cast<std::size_t>(side)]; }

std::string_view unit_of(ControlUnit unit) {
    switch (unit) {
        case ControlUnit::centimetres:
            return " cm";
        case ControlUnit::degrees:
            return " degrees";
        case ControlUnit::share:
            return "";
    }
    return "";
}

// Keys must lie in [0, beats): the next repeat has its own key at `beats`.
std::optional<FigureFault> fault_in_keys(const AuthoredFigure& figure) {
    for (std::size_t i = 0; i < kControlCount; ++i) {
        for (const Track& track : figure.body[i]) {
            if (!track.has_keys()) {
                continue;
            }
            const double first = track.keys.front().beat;
            const double last = track.keys.back().beat;
            if (first < 0.0 || last >= figure.beats) {
                return FigureFault{
                    figure.line,
                    fmt::format("beat {}: a key of {} lies outside the figure's {} beats (0 is its "
                                "first; the next repeat begins at {})",
                                first < 0.0 ? first : last,
                                info_of(static_cast<Control>(i)).name,
                                figure.beats,
                                figure.beats)};
            }
        }
    }
    return std::nullopt;
}

/// The beat at which one track of a control is furthest out, for the message. `direction`: +1 up,
/// -1 down.
double beat_of_extreme(const std::vector<Track>& tracks, double direction) {
    double beat = 0.0;
    double most = -1e300;
    for (const Track& track : tracks) {
        if (!track.has_keys() && track.wave != 0.0 && direction * track.wave > most) {
            most = direction * track.wave;
            beat = track.peak;
        }
        for (const TrackKey& key : track.keys) {
            if (direction * key.value > most) {
                most = direction * key.value;
                beat = key.beat;
            }
        }
    }
    return beat;
}

// The sum of the tracks' extremes: an upper bound, as they may lie at different beats.
std::optional<FigureFault> fault_in_limits(const AuthoredFigure& figure) {
    constexpr double kRounding = 1e-9;
    for (std::size_t i = 0; i < kControlCount; ++i) {
        const ControlInfo& info = info_of(static_cast<Control>(i));
        double low = 0.0;
        double high = 0.0;
        for (const Track& track : figure.body[i]) {
            low += track.lowest();
            high += track.highest();
        }
        const bool is_high = high > info.highest + kRounding;
        if (is_high || low < info.lowest - kRounding) {
            return FigureFault{
                figure.line,
                fmt::format("beat {:.4g}: {} comes to {:.4g}{}, must stay within {} to {}",
                            beat_of_extreme(figure.body[i], is_high ? 1.0 : -1.0),
                            info.name,
                            is_high ? high : low,
                            unit_of(info.unit),
                            info.lowest,
                            info.highest)};
        }
    }
    return std::nullopt;
}

/// The steps of one foot in order, followed by the first one that it makes in the next repeat.
std::vector<FootStep> steps_of(const AuthoredFigure& figure, Side side) {
    std::vector<FootStep> steps;
    for (const FootStep& step : figure.steps) {
        if (step.foot == side) {
            steps.push_back(step);
        }
    }
    // A mirrored repeat begins with the other foot's steps in this one's place.
    const auto follows =
        std::find_if(figure.steps.begin(), figure.steps.end(), [&](const FootStep& step) {
            return (step.foot == side) != figure.is_mirrored;
        });
    if (follows != figure.steps.end()) {
        steps.push_back(*follows);
        steps.back().at += figure.beats;
    }
    return steps;
}

/// Steps of a foot may overlap a little, as the later one is then shortened (separate() in
/// step_layout.cpp), but at least half of its time in the air must be left.
std::optional<FigureFault> fault_in_steps(const AuthoredFigure& figure) {
    constexpr double kLeastShare = 0.5;
    for (const Side side : kSides) {
        const std::vector<FootStep> steps = steps_of(figure, side);
        for (std::size_t i = 1; i < steps.size(); ++i) {
            const double gap = steps[i].at + steps[i].land - steps[i - 1].at - steps[i - 1].land;
            if (gap < kLeastShare * steps[i].air) {
                return FigureFault{
                    steps[i].line,
                    fmt::format(
                        "beat {:.4g}: {} leaves the floor at {:.4g} and only lands from the "
                        "step before at {:.4g}; shorten air or land later",
                        steps[i].at,
                        name_of(side),
                        steps[i].at + steps[i].land - steps[i].air,
                        steps[i - 1].at + steps[i - 1].land)};
            }
        }
    }
    return std::nullopt;
}

/// The balls of both feet must not be closer than a foot is wide.
std::optional<FigureFault> fault_in_places(const AuthoredFigure& figure) {
    constexpr double kFootWidth = 4.0;  // cm; balls nearer than this stand on one another
    std::array<std::optional<glm::dvec2>, 2> places;
    // Two rounds: at the start of the figure the other foot stands where its last step left it.
    for (int round = 0; round < 2; ++round) {
        for (const FootStep& step : figure.steps) {
            const auto s = static_cast<std::size_t>(step.foot);
            if (step.to) {
                places[s] = *step.to;
            }
            const auto& other = places[1 - s];
            // Only in figures that stay: in others places of different repeats are in different
            // frames.
            if (figure.stays() && !figure.is_mirrored && places[s] && other &&
                glm::length(*places[s] - *other) < kFootWidth) {
                return FigureFault{step.line,
                                   fmt::format("beat {:.4g}: {} lands on the {} ({:.1f} cm between "
                                               "the balls, must be {})",
                                               step.at,
                                               name_of(step.foot),
                                               name_of(kSides[1 - s]),
                                               glm::length(*places[s] - *other),
                                               kFootWidth)};
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<FigureFault> first_fault(const AuthoredFigure& figure) {
    for (const auto& check : {fault_in_keys, fault_in_limits, fault_in_steps, fault_in_places}) {
        if (auto fault = check(figure)) {
            return fault;
        }
    }
    return std::nullopt;
}

namespace {

constexpr double kMostMiss = 0.02;  // metres; up to here heel lift and soft knees hide it

// The farthest miss, if it is more than kMostMiss.
const ReachMiss* worst_miss(const EvaluatedFigure& evaluated) {
    const auto worst = std::max_element(
        evaluated.misses.begin(), evaluated.misses.end(), [](const auto& a, const auto& b) {
            return a.metres < b.metres;
        });
    const bool is_far = worst != evaluated.misses.end() && worst->metres > kMostMiss;
    return is_far ? &*worst : nullptr;
}

// Beat within the figure of a frame.
double beat_of(const EvaluatedFigure& evaluated, std::size_t frame) {
    const double beat =
        evaluated.first_beat + static_cast<double>(frame) * evaluated.beats_per_frame;
    return beat - evaluated.beats * std::floor(beat / evaluated.beats);
}

// The joint furthest beyond its limits, and when.
struct JointFault {
    JointExcess joint;
    double beat = 0.0;
};

std::optional<JointFault> worst_joint_of(const EvaluatedFigure& evaluated) {
    std::optional<JointFault> worst;
    for (std::size_t i = 0; i < evaluated.poses.size(); ++i) {
        const auto joint = worst_joint(evaluated.poses[i]);
        if (joint && (!worst || joint->beyond() > worst->joint.beyond())) {
            worst = {*joint, beat_of(evaluated, i)};
        }
    }
    return worst;
}

// The hand deepest in the body, and when.
struct HandFault {
    HandClearance hand;
    double beat = 0.0;
};

std::optional<HandFault> deepest_hand_of(const EvaluatedFigure& evaluated,
                                         const Skeleton& skeleton) {
    std::optional<HandFault> deepest;
    for (std::size_t i = 0; i < evaluated.poses.size(); ++i) {
        const HandClearance hand = hand_clearance(skeleton, evaluated.poses[i]);
        if (hand.metres < (deepest ? deepest->hand.metres : -kMostHandDepth)) {
            deepest = {hand, beat_of(evaluated, i)};
        }
    }
    return deepest;
}

/// The worst of each kind over all tempi.
struct WorstFaults {
    std::optional<ReachMiss> miss;
    std::optional<JointFault> joint;
    std::optional<HandFault> hand;
};

std::vector<std::string> lines_of(const AuthoredDance& dance,
                                  const AuthoredFigure& figure,
                                  const WorstFaults& worst) {
    std::vector<std::string> faults;
    if (worst.miss) {
        faults.push_back(
            fmt::format("{}: beat {:.4g}: {} foot cannot be reached: {:.0f} cm too "
                        "far; bring it nearer or bend the carrying knee more",
                        where_in(dance, figure),
                        worst.miss->beat,
                        worst.miss->foot == Side::left ? "left" : "right",
                        100.0 * worst.miss->metres));
    }
    if (worst.joint) {
        faults.push_back(
            fmt::format("{}: beat {:.2f}: {} comes to {:.0f} degrees, must stay "
                        "within {:.0f} to {:.0f}",
                        where_in(dance, figure),
                        worst.joint->beat,
                        worst.joint->joint.joint,
                        worst.joint->joint.degrees,
                        worst.joint->joint.lowest,
                        worst.joint->joint.highest));
    }
    if (worst.hand) {
        faults.push_back(
            fmt::format("{}: beat {:.2f}: {} hand goes {:.1f} cm into the {}; move "
                        "the arm (up, front, bend) away from it",
                        where_in(dance, figure),
                        worst.hand->beat,
                        worst.hand->hand.hand == Side::left ? "left" : "right",
                        -100.0 * worst.hand->hand.metres,
                        worst.hand->hand.part));
    }
    return faults;
}

}  // namespace

std::vector<std::string> faults_in_motion(const AuthoredDance& dance,
                                          const AuthoredFigure& figure,
                                          const Skeleton& skeleton) {
    constexpr double kFramesPerSecond = 30.0;  // half the usual rate, for speed
    WorstFaults worst;
    for (const Bpm tempo : {dance.slowest, dance.written, dance.fastest}) {
        EvaluationOptions options;
        options.written = dance.written;
        options.tempo = tempo;
        // One of each side.
        options.repeats = figure.is_mirrored ? 2 : 1;
        // Without noise, so that a figure fails for what is written, not by chance.
        options.noise = 0.0;
        options.frames_per_second = kFramesPerSecond;
        const EvaluatedFigure evaluated = evaluate_figure(figure, skeleton, options);
        const ReachMiss* const far = worst_miss(evaluated);
        if (far != nullptr && (!worst.miss || far->metres > worst.miss->metres)) {
            worst.miss = *far;
        }
        const auto out = worst_joint_of(evaluated);
        if (out && (!worst.joint || out->joint.beyond() > worst.joint->joint.beyond())) {
            worst.joint = out;
        }
        const auto deep = deepest_hand_of(evaluated, skeleton);
        if (deep && (!worst.hand || deep->hand.metres < worst.hand->hand.metres)) {
            worst.hand = deep;
        }
    }
    return lines_of(dance, figure, worst);
}

}  // namespace raks::motion
