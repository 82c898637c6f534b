#include "motion/choreography/figure_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "base/statistics.hpp"
#include "motion/choreography/figure_evaluation.hpp"
#include "motion/choreography/joint_limits.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/repeat_measures.hpp"
#include "motion/skeleton/body_capsules.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr int kRepeats = 12;        // evaluated to measure a figure
constexpr double kLeastKnee = 5.0;  // degrees of bend; a straighter knee counts as locked

/// Length of the hips' path over the floor, metres.
double hip_path(const BodyTrack& track) {
    double path = 0.0;
    for (std::size_t i = 1; i < track.frames(); ++i) {
        glm::dvec3 step = track.joints[i][0] - track.joints[i - 1][0];
        step.y = 0.0;
        path += glm::length(step);
    }
    return path;
}

// Adds a line where a value is outside its range; NaN counts as outside.
void check_range(const std::optional<ValueRange>& range,
                 double value,
                 std::string_view what,
                 const std::string& where,
                 std::vector<std::string>& faults) {
    if (range && !(value >= range->lowest && value <= range->highest)) {
        faults.push_back(fmt::format(
            "{}: {} {:.3g}, expected {} to {}", where, what, value, range->lowest, range->highest));
    }
}

/// Median distance between every two repeats; metres.
double distance_of_repeats(const FigureTake& take, const BodyTrack& track) {
    std::vector<FigureShape> shapes;
    for (int repeat = 0; repeat < take.repeats; ++repeat) {
        std::vector<double> times;
        // The shape is resampled by these beat times; repeats cut off at the ends of the take give
        // none.
        for (int beat = 0; beat <= take.beats; ++beat) {
            times.push_back((repeat * take.beats + beat - take.first_beat) *
                            take.tempo.seconds_per_beat());
        }
        if (const auto shape = figure_shape(track, times)) {
            shapes.push_back(*shape);
        }
    }
    return percentile(repeat_distances(shapes), 0.5);
}

/// Bend of a knee: angle between thigh and shin, degrees.
double knee_bend(const Skeleton& skeleton, const Pose& pose, Side side) noexcept {
    const Bone shin = on_side(Bone::left_lower_leg, side);
    const Bone foot = on_side(Bone::left_foot, side);
    const glm::dvec3 thigh_line = glm::normalize(glm::dvec3(skeleton.offsets[index_of(shin)]));
    const glm::dvec3 shin_line = glm::normalize(glm::dquat(pose.rotation(shin)) *
                                                glm::dvec3(skeleton.offsets[index_of(foot)]));
    return std::acos(std::clamp(glm::dot(thigh_line, shin_line), -1.0, 1.0)) * 180.0 / M_PI;
}

/// The measures of single poses: hands in the body, knees, joints.
void measure_poses(const FigureTake& take, const Skeleton& skeleton, TakeMeasures& measures) {
    measures.hand_clearance = 1e9;
    measures.least_knee = 180.0;
    const double beats_a_frame = 1.0 / (take.tempo.seconds_per_beat() * take.frames_per_second);
    for (std::size_t i = 0; i < take.poses.size(); ++i) {
        const Pose& pose = take.poses[i];
        for (const Side side : kSides) {
            measures.least_knee = std::min(measures.least_knee, knee_bend(skeleton, pose, side));
        }
        const HandClearance hand = hand_clearance(skeleton, pose);
        if (hand.metres < measures.hand_clearance) {
            const double beat = take.first_beat + static_cast<double>(i) * beats_a_frame;
            measures.hand_clearance = hand.metres;
            measures.hand_near = fmt::format("{} hand, {}, beat {:.1f}",
                                             hand.hand == Side::left ? "left" : "right",
                                             hand.part,
                                             beat - take.beats * std::floor(beat / take.beats));
        }
        const auto joint = worst_joint(pose);
        if (joint && joint->beyond() > measures.joint_excess) {
            measures.joint_excess = joint->beyond();
            measures.joint = joint->joint;
        }
    }
}

}  // namespace

TakeMeasures measure_take(const FigureTake& take, const Skeleton& skeleton) {
    const BodyTrack track = body_track(skeleton, take.poses, take.frames_per_second);
    const double frames_a_beat = take.tempo.seconds_per_beat() * take.frames_per_second;
    const double beats = static_cast<double>(take.poses.size() - 1) / frames_a_beat;

    TakeMeasures measures;
    constexpr double kCentimetres = 100.0;
    measures.hip_travel = kCentimetres * hip_path(track) / beats;
    const ContactReport contacts = contacts_of(track, 0.0);
    // Contacts that last all the time (standing) have not begun.
    measures.toe_contacts =
        static_cast<double>(contacts.slips.size() - contacts.standing) * take.beats_per_bar / beats;
    measures.slip_p90 = contacts.slip_p90;
    const HandTiming hands = hand_timing(track, frames_a_beat);
    measures.hand_delay = hands.delay;
    measures.hand_likeness = hands.likeness;
    const JerkReport jerk = jerk_of(track);
    measures.jerk_rms = jerk.rms;
    measures.jerk_p999 = jerk.p999;
    measures.repeat_distance = distance_of_repeats(take, track);
    measure_poses(take, skeleton, measures);
    return measures;
}

TakeMeasures measure_figure(const AuthoredDance& dance,
                            const AuthoredFigure& figure,
                            const Skeleton& skeleton) {
    // A mirrored figure repeats after both sides.
    const int sides = figure.is_mirrored ? 2 : 1;
    EvaluationOptions options;
    options.written = options.tempo = dance.written;
    options.repeats = kRepeats * sides;
    options.margin = 0.5;
    const EvaluatedFigure evaluated = evaluate_figure(figure, skeleton, options);
    return measure_take({evaluated.poses,
                         options.frames_per_second,
                         options.tempo,
                         evaluated.first_beat,
                         figure.beats * sides,
                         kRepeats,
                         dance.beats_per_bar},
                        skeleton);
}

std::vector<std::string> faults_in_measures(const AuthoredDance& dance,
                                            const AuthoredFigure& figure,
                                            const TakeMeasures& measures) {
    const FigureExpectation& expected = figure.expectation;
    const std::string where = where_in(dance, figure);
    std::vector<std::string> faults;
    check_range(expected.hip_travel, measures.hip_travel, "hips travel, cm a beat,", where, faults);
    check_range(
        expected.toe_contacts, measures.toe_contacts, "toe contacts a bar are", where, faults);
    check_range(
        expected.hand_delay, measures.hand_delay, "hands trail the head by, beats,", where, faults);
    if (expected.hand_delay && measures.hand_likeness < kLeastHandLikeness) {
        faults.push_back(fmt::format(
            "{}: hands have little to do with the head: they go alike by {:.2f}, must by "
            "{:.2f}",
            where,
            measures.hand_likeness,
            kLeastHandLikeness));
    }
    const JerkBound bound = expected.jerk.value_or(JerkBound{});
    check_range(ValueRange{0.0, bound.rms}, measures.jerk_rms, "jerk rms is", where, faults);
    check_range(ValueRange{0.0, bound.p999}, measures.jerk_p999, "jerk p99.9 is", where, faults);
    return faults;
}

std::vector<std::string> faults_in_poses(const AuthoredDance& dance,
                                         const AuthoredFigure& figure,
                                         const TakeMeasures& measures) {
    const std::string where = where_in(dance, figure);
    std::vector<std::string> faults;
    if (measures.hand_clearance < -kMostHandDepth) {
        faults.push_back(fmt::format("{}: a hand goes {:.1f} cm into the body ({})",
                                     where,
                                     -100.0 * measures.hand_clearance,
                                     measures.hand_near));
    }
    if (measures.least_knee < kLeastKnee) {
        faults.push_back(fmt::format("{}: a knee locks: {:.1f} degrees of bend, must be {:.0f}",
                                     where,
                                     measures.least_knee,
                                     kLeastKnee));
    }
    if (measures.joint_excess > 0.0) {
        faults.push_back(fmt::format("{}: {} is {:.0f} degrees beyond its limits",
                                     where,
                                     measures.joint,
                                     measures.joint_excess));
    }
    return faults;
}

namespace {

using Moves = std::vector<glm::dvec3>;  // displacements by frame, metres

// Index of a bone among the track's joints.
std::size_t index_in_body(Bone bone) {
    return static_cast<std::size_t>(std::find(kBodyBones.begin(), kBodyBones.end(), bone) -
                                    kBodyBones.begin());
}

/// Displacements of a joint from frame to frame, without their mean (the drift).
Moves moves_of(const BodyTrack& track, Bone bone) {
    const std::size_t joint = index_in_body(bone);
    Moves moves;
    glm::dvec3 drift(0.0);
    for (std::size_t i = 1; i < track.frames(); ++i) {
        moves.push_back(track.joints[i][joint] - track.joints[i - 1][joint]);
        drift += moves.back();
    }
    for (glm::dvec3& move : moves) {
        move -= drift / static_cast<double>(moves.size());
    }
    return moves;
}

/// Adds the cross-correlation of head and hand to `likeness`, by shift from -reach to reach frames;
/// adds the product of both norms to `most`, the correlation that equal motion would have.
void add_likeness(const Moves& head,
                  const Moves& hand,
                  std::ptrdiff_t reach,
                  std::vector<double>& likeness,
                  double& most) {
    // Only frames for which every shift exists, so that all shifts sum equally many terms.
    const auto end = static_cast<std::ptrdiff_t>(head.size()) - reach;
    double head_square = 0.0;
    double hand_square = 0.0;
    for (std::ptrdiff_t i = reach; i < end; ++i) {
        const glm::dvec3& at_head = head[static_cast<std::size_t>(i)];
        for (std::ptrdiff_t shift = -reach; shift <= reach; ++shift) {
            likeness[static_cast<std::size_t>(shift + reach)] +=
                glm::dot(at_head, hand[static_cast<std::size_t>(i + shift)]);
        }
        const glm::dvec3& at_hand = hand[static_cast<std::size_t>(i)];
        head_square += glm::dot(at_head, at_head);
        hand_square += glm::dot(at_hand, at_hand);
    }
    most += std::sqrt(head_square * hand_square);
}

/// Centroid of the part around the peak that exceeds kNearlyAsHigh of it, weighted by the excess.
/// (The exact peak of a flat curve is set by noise.)
double middle_of_peak(const std::vector<double>& likeness) {
    constexpr double kNearlyAsHigh = 0.8;
    const auto peak = std::max_element(likeness.begin(), likeness.end());
    const double least = kNearlyAsHigh * *peak;
    auto from = peak;
    while (from != likeness.begin() && *(from - 1) > least) {
        --from;
    }
    double weights = 0.0;
    double sum = 0.0;
    for (auto at = from; at != likeness.end() && *at > least; ++at) {
        weights += *at - least;
        sum += (*at - least) * static_cast<double>(at - likeness.begin());
    }
    return weights > 0.0 ? sum / weights : static_cast<double>(peak - likeness.begin());
}

}  // namespace

HandTiming hand_timing(const BodyTrack& track, double frames_a_beat) {
    const auto reach = static_cast<std::ptrdiff_t>(0.5 * frames_a_beat);
    const Moves head = moves_of(track, Bone::head);
    std::vector<double> likeness(static_cast<std::size_t>(2 * reach + 1), 0.0);
    double most = 0.0;
    for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
        add_likeness(head, moves_of(track, hand), reach, likeness, most);
    }
    const double best = *std::max_element(likeness.begin(), likeness.end());
    if (!(best > 0.0)) {
        return {};  // head or hands stand still, or correlate negatively at every shift
    }
    return {(middle_of_peak(likeness) - static_cast<double>(reach)) / frames_a_beat, best / most};
}

}  // namespace raks::motion
