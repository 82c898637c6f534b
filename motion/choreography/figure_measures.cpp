#include "motion/choreography/figure_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "motion/choreography/figure_evaluation.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/repeat_distance.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr int kRepeats = 6;

std::size_t index_in_body(Bone bone) {
    return static_cast<std::size_t>(std::find(kBodyBones.begin(), kBodyBones.end(), bone) -
                                    kBodyBones.begin());
}

/// Path of the hips seen from above, metres.
double hip_path(const BodyTrack& track) {
    double path = 0.0;
    for (std::size_t i = 1; i < track.frames(); ++i) {
        glm::dvec3 step = track.joints[i][0] - track.joints[i - 1][0];
        step.y = 0.0;
        path += glm::length(step);
    }
    return path;
}

/// Speeds of some joints added up, by frame.
std::vector<double> speeds_of(const BodyTrack& track, std::initializer_list<Bone> bones) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < track.frames(); ++i) {
        double sum = 0.0;
        for (const Bone bone : bones) {
            const std::size_t j = index_in_body(bone);
            sum += glm::distance(track.joints[i][j], track.joints[i - 1][j]);
        }
        speeds.push_back(sum);
    }
    return speeds;
}

/// Frames by which `late` follows `early`: where their correlation is greatest within `reach`.
double delay_of(const std::vector<double>& early,
                const std::vector<double>& late,
                std::ptrdiff_t reach) {
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) {
            sum += value;
        }
        return sum / static_cast<double>(values.size());
    };
    const double early_mean = mean(early);
    const double late_mean = mean(late);
    const auto count = static_cast<std::ptrdiff_t>(early.size());
    double best = -1e300;
    double delay = 0.0;
    for (std::ptrdiff_t shift = -reach; shift <= reach; ++shift) {
        double sum = 0.0;
        for (std::ptrdiff_t i = reach; i < count - reach; ++i) {
            sum += (early[static_cast<std::size_t>(i)] - early_mean) *
                   (late[static_cast<std::size_t>(i + shift)] - late_mean);
        }
        if (sum > best) {
            best = sum;
            delay = static_cast<double>(shift);
        }
    }
    return delay;
}

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

}  // namespace

FigureMeasures measure_figure(const AuthoredDance& dance,
                              const AuthoredFigure& figure,
                              const Skeleton& skeleton) {
    const int sides = figure.is_mirrored ? 2 : 1;
    EvaluationOptions options;
    options.written = options.tempo = dance.written;
    options.repeats = kRepeats * sides;
    options.margin = 0.5;
    const EvaluatedFigure evaluated = evaluate_figure(figure, skeleton, options);
    const BodyTrack track = body_track(skeleton, evaluated.poses, options.frames_per_second);
    const double beats = static_cast<double>(options.repeats) * figure.beats + 2.0 * options.margin;

    FigureMeasures measures;
    constexpr double kCentimetres = 100.0;
    measures.hip_travel = kCentimetres * hip_path(track) / beats;
    const ContactReport contacts = contacts_of(track, 0.0);
    measures.toe_contacts =
        static_cast<double>(contacts.slips.size()) * dance.beats_per_bar / beats;
    measures.slip_p90 = contacts.slip_p90;
    const double frames_a_beat = 1.0 / evaluated.beats_per_frame;
    measures.hand_delay = delay_of(speeds_of(track, {Bone::head}),
                                   speeds_of(track, {Bone::left_hand, Bone::right_hand}),
                                   static_cast<std::ptrdiff_t>(0.5 * frames_a_beat)) /
                          frames_a_beat;
    const JerkReport jerk = jerk_of(track);
    measures.jerk_rms = jerk.rms;
    measures.jerk_p999 = jerk.p999;
    std::vector<FigureShape> shapes;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        std::vector<double> times;
        for (int beat = 0; beat <= figure.beats * sides; ++beat) {
            times.push_back((options.margin + repeat * figure.beats * sides + beat) *
                            options.tempo.seconds_per_beat());
        }
        if (const auto shape = figure_shape(track, times)) {
            shapes.push_back(*shape);
        }
    }
    measures.repeat_distance = percentile(repeat_distances(shapes), 0.5);
    return measures;
}

std::vector<std::string> faults_in_measures(const AuthoredDance& dance,
                                            const AuthoredFigure& figure,
                                            const FigureMeasures& measures) {
    const FigureExpectation& expected = figure.expectation;
    const std::string where = where_in(dance, figure);
    std::vector<std::string> faults;
    check_range(expected.hip_travel, measures.hip_travel, "hips travel, cm a beat,", where, faults);
    check_range(
        expected.toe_contacts, measures.toe_contacts, "toe contacts a bar are", where, faults);
    check_range(
        expected.hand_delay, measures.hand_delay, "hands trail the head by, beats,", where, faults);
    const JerkBound bound = expected.jerk.value_or(JerkBound{});
    check_range(ValueRange{0.0, bound.rms}, measures.jerk_rms, "jerk rms is", where, faults);
    check_range(ValueRange{0.0, bound.p999}, measures.jerk_p999, "jerk p99.9 is", where, faults);
    return faults;
}

}  // namespace raks::motion
