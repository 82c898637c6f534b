#include "motion/choreography/motion_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/figure_measures.hpp"
#include "motion/choreography/joint_limits.hpp"
#include "motion/skeleton/body_capsules.hpp"

namespace raks::motion {
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
