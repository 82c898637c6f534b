// Figure measures: what a danced figure measures, and whether that is as expected.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/beats.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

struct BodyTrack;  // motion/evaluate/body_track.hpp

/// Depth of a hand in the body that clothes and flesh allow; metres.
inline constexpr double kMostHandDepth = 0.015;

/// Likeness below which no delay between head and hands can be measured: the hands move
/// independently, or are still.
inline constexpr double kLeastHandLikeness = 0.1;

/// Poses of a figure danced several times, whatever made them.
struct FigureTake {
    std::span<const Pose> poses;      ///< equidistant in time
    double frames_per_second = 60.0;  ///< of the poses
    Bpm tempo{120.0};                 ///< at which they are danced
    double first_beat = 0.0;          ///< beat of pose 0, <= 0; the first repeat begins at beat 0
    int beats = 4;                    ///< of one repeat; a mirrored figure counts both sides as one
    int repeats = 1;                  ///< in the poses
    int beats_per_bar = 4;            ///< of the dance
};

/// What a figure does, danced several times at the written tempo.
struct TakeMeasures {
    double hip_travel = 0.0;       ///< path of the hips over the floor, cm a beat
    double toe_contacts = 0.0;     ///< contacts of both toes that begin, a bar
    double hand_delay = 0.0;       ///< beats by which the hands follow the head; hand_timing()
    double hand_likeness = 0.0;    ///< correlation of their motion, [0, 1]
    double jerk_rms = 0.0;         ///< m/s^3, motion/evaluate/dance_metrics.hpp
    double jerk_p999 = 0.0;        ///< 99.9th percentile, m/s^3
    double slip_p90 = 0.0;         ///< of a contact, 90th percentile; metres
    double repeat_distance = 0.0;  ///< median distance of two repeats, metres; repeat_distances()
    /// Least distance of a hand from the body; negative: inside; metres
    double hand_clearance = 0.0;
    std::string hand_near;      ///< "left hand, trunk, beat 2.5": where that is
    double least_knee = 0.0;    ///< bend of the straightest knee, degrees
    double joint_excess = 0.0;  ///< greatest angle beyond worst_joint()'s limits, degrees
    std::string joint;          ///< which joint that is
};

/// Measures a take. Threads: workers. Real-time: no (some 10 ms).
[[nodiscard]] TakeMeasures measure_take(const FigureTake& take, const Skeleton& skeleton);

/// Evaluates a written figure with noise, 12 repeats at the written tempo (24 where it is
/// mirrored), and measures it. Threads: workers. Real-time: no (some 10 ms).
[[nodiscard]] TakeMeasures measure_figure(const AuthoredDance& dance,
                                          const AuthoredFigure& figure,
                                          const Skeleton& skeleton);

/// The measures outside the figure's expectations, one line each: `belly.toml: line 12: figure
/// "drop": hips travel 0.4 cm a beat, expected 3 to 20`. The jerk is bounded by 350 m/s^3 rms and
/// 2,000 (99.9 %) unless the file says otherwise.
[[nodiscard]] std::vector<std::string> faults_in_measures(const AuthoredDance& dance,
                                                          const AuthoredFigure& figure,
                                                          const TakeMeasures& measures);

/// What no body could dance, one line each: hands more than kMostHandDepth inside it, joints beyond
/// their limits, locked knees. (Written figures are also held to it without noise:
/// figure_check.hpp.)
[[nodiscard]] std::vector<std::string> faults_in_poses(const AuthoredDance& dance,
                                                       const AuthoredFigure& figure,
                                                       const TakeMeasures& measures);

// Hand timing: how far the hands follow the head.

/// How the hands' motion follows the head's. Velocities are compared as vectors, not as speeds: two
/// arms that take turns are never slow together, and a speed, which has no direction, peaks twice
/// in a cycle of the motion, so a delay half a beat too short would fit nearly as well.
struct HandTiming {
    double delay = 0.0;     ///< beats by which the hands follow the head, [-0.5, 0.5]
    double likeness = 0.0;  ///< normalised correlation at that delay, [0, 1]
};

/// The delay d that maximises the sum over both hands and all frames of v_head(t) . v_hand(t + d):
/// the weighted middle of the part around the peak that exceeds 0.8 of it, since the exact position
/// of a flat peak is set by noise. The likeness is the peak divided by the norms of both. Both are
/// 0 where head or hands stand still. `frames_a_beat` >= 2; the track must be longer than a beat.
/// Threads: any. Real-time: no.
[[nodiscard]] HandTiming hand_timing(const BodyTrack& track, double frames_a_beat);

}  // namespace raks::motion
