#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Clothes and flesh give way so far; metres.
inline constexpr double kMostHandDepth = 0.015;

/// Under it no delay between head and hands can be told: hands on strings, or still in the air.
inline constexpr double kLeastHandLikeness = 0.1;

/// A figure danced over and over, from wherever the poses come.
struct FigureTake {
    std::span<const Pose> poses;
    double frames_per_second = 60.0;
    Bpm tempo{120.0};
    double first_beat = 0.0;  ///< beat of pose 0, <= 0; the first repeat begins at beat 0
    int beats = 4;            ///< of a repeat, both sides of a mirrored figure together
    int repeats = 1;
    int beats_per_bar = 4;
};

/// What a figure does, danced several times at the written tempo.
struct TakeMeasures {
    double hip_travel = 0.0;     ///< path of the hips over the floor, cm a beat
    double toe_contacts = 0.0;   ///< contacts of both toes that begin, a bar
    double hand_delay = 0.0;     ///< of the hands behind the head, beats; hand_timing.hpp
    double hand_likeness = 0.0;  ///< how much they go as the head goes, [0, 1]
    double jerk_rms = 0.0;       ///< m/s^3, motion/evaluate/dance_metrics.hpp
    double jerk_p999 = 0.0;
    double slip_p90 = 0.0;         ///< metres a contact
    double repeat_distance = 0.0;  ///< between two repeats, median; repeat_distance.hpp; metres
    double hand_clearance = 0.0;   ///< of hands from the body, least; negative: deep in it; metres
    std::string hand_near;         ///< "left hand, trunk, beat 2.5": where that is
    double least_knee = 0.0;       ///< straightest knee, degrees of bend
    double joint_excess = 0.0;     ///< beyond joint_limits.hpp, most; degrees
    std::string joint;             ///< which
};

/// Threads: workers. Real-time: no (some 10 ms).
[[nodiscard]] TakeMeasures measure_take(const FigureTake& take, const Skeleton& skeleton);

/// Of the figure as it is written, danced with noise.

/// Threads: workers. Real-time: no (some 10 ms).
[[nodiscard]] TakeMeasures measure_figure(const AuthoredDance& dance,
                                          const AuthoredFigure& figure,
                                          const Skeleton& skeleton);

/// What is outside the figure's expectations, one line each: `belly.toml: line 12: figure "drop":
/// hips travel 0.4 cm a beat, expected 3 to 20`. Jerk: 350 m/s^3 rms and 2,000 (99.9 %) at most
/// unless the file says otherwise.
[[nodiscard]] std::vector<std::string> faults_in_measures(const AuthoredDance& dance,
                                                          const AuthoredFigure& figure,
                                                          const TakeMeasures& measures);

/// What a danced body cannot do, one line each: hands more than kMostHandDepth in it, joints beyond
/// their limits, knees locked. (Figures as written are held to it without noise: motion_check.hpp.)
[[nodiscard]] std::vector<std::string> faults_in_poses(const AuthoredDance& dance,
                                                       const AuthoredFigure& figure,
                                                       const TakeMeasures& measures);

}  // namespace raks::motion
