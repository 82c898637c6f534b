#include "motion/choreography/motion_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/joint_limits.hpp"

namespace raks::motion {
namespace {

constexpr double kMostMiss = 0.02;  // metres; what heels and soft knees do not hide

const ReachMiss* worst_miss(const EvaluatedFigure& evaluated) {
    const auto worst = std::max_element(
        evaluated.misses.begin(), evaluated.misses.end(), [](const auto& a, const auto& b) {
            return a.metres < b.metres;
        });
    const bool is_far = worst != evaluated.misses.end() && worst->metres > kMostMiss;
    return is_far ? &*worst : nullptr;
}

struct JointFault {
    JointExcess joint;
    double beat = 0.0;
};

std::optional<JointFault> worst_joint_of(const EvaluatedFigure& evaluated) {
    std::optional<JointFault> worst;
    for (std::size_t i = 0; i < evaluated.poses.size(); ++i) {
        const auto joint = worst_joint(evaluated.poses[i]);
        if (joint && (!worst || joint->beyond() > worst->joint.beyond())) {
            const double beat =
                evaluated.first_beat + static_cast<double>(i) * evaluated.beats_per_frame;
            worst = {*joint, beat - evaluated.beats * std::floor(beat / evaluated.beats)};
        }
    }
    return worst;
}

}  // namespace

std::vector<std::string> faults_in_motion(const AuthoredDance& dance,
                                          const AuthoredFigure& figure,
                                          const Skeleton& skeleton) {
    constexpr double kFramesPerSecond = 30.0;
    std::optional<ReachMiss> miss;
    std::optional<JointFault> joint;
    for (const Bpm tempo : {dance.slowest, dance.written, dance.fastest}) {
        EvaluationOptions options;
        options.written = dance.written;
        options.tempo = tempo;
        options.repeats = figure.is_mirrored ? 2 : 1;
        options.noise = 0.0;
        options.frames_per_second = kFramesPerSecond;
        const EvaluatedFigure evaluated = evaluate_figure(figure, skeleton, options);
        const ReachMiss* const far = worst_miss(evaluated);
        if (far != nullptr && (!miss || far->metres > miss->metres)) {
            miss = *far;
        }
        const auto out = worst_joint_of(evaluated);
        if (out && (!joint || out->joint.beyond() > joint->joint.beyond())) {
            joint = out;
        }
    }
    std::vector<std::string> faults;
    if (miss) {
        faults.push_back(
            fmt::format("{}: beat {:.4g}: {} foot cannot be reached: {:.0f} cm too "
                        "far; bring it nearer or bend the carrying knee more",
                        where_in(dance, figure),
                        miss->beat,
                        miss->foot == Side::left ? "left" : "right",
                        100.0 * miss->metres));
    }
    if (joint) {
        faults.push_back(
            fmt::format("{}: beat {:.2f}: {} comes to {:.0f} degrees, must stay "
                        "within {:.0f} to {:.0f}",
                        where_in(dance, figure),
                        joint->beat,
                        joint->joint.joint,
                        joint->joint.degrees,
                        joint->joint.lowest,
                        joint->joint.highest));
    }
    return faults;
}

}  // namespace raks::motion
