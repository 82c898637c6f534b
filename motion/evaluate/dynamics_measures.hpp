// Dynamics: how a dance spends its speed: rests, holds, hits, and bars that are not alike.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "motion/evaluate/body_track.hpp"

namespace raks::motion {

/// The bones whose joints the dynamics are measured at; the last two are for facing only.
inline constexpr std::array<Bone, 18> kDynamicsBones = {
    Bone::hips,
    Bone::upper_chest,
    Bone::neck,
    Bone::head,
    Bone::left_upper_arm,
    Bone::left_lower_arm,
    Bone::left_hand,
    Bone::right_upper_arm,
    Bone::right_lower_arm,
    Bone::right_hand,
    Bone::left_lower_leg,
    Bone::left_foot,
    Bone::left_toes,
    Bone::right_lower_leg,
    Bone::right_foot,
    Bone::right_toes,
    Bone::left_upper_leg,
    Bone::right_upper_leg,
};
/// How many of them make up the body.
inline constexpr std::size_t kMovingBones = 16;
/// Samples a second at which the dynamics are measured.
inline constexpr double kDynamicsRate = 60.0;

/// A stretch of a dance, seconds from its first frame.
struct DanceStretch {
    double from = 0.0;                                    ///< start
    double to = std::numeric_limits<double>::infinity();  ///< end; at most the last frame's time
};

/// Places of the joints at kDynamicsRate, smoothed by a Gaussian of 20 ms. Every body is scaled to
/// a leg (hip to ankle) of 0.83 m, so that people and dancers of any size compare; metres, y up.
struct DynamicsTrack {
    double begins = 0.0;  ///< time of the first frame in the dance, seconds
    std::array<Places, kDynamicsBones.size()> world;  ///< by bone
    /// The same in the body's frame: over the floor from the point below the hips, turned by the
    /// facing of the last second or so (a Gaussian of 0.5 s); +z is forward, +x the left.
    std::array<Places, kDynamicsBones.size()> body;

    /// Number of frames.
    [[nodiscard]] std::size_t frames() const noexcept { return world[0].size(); }
};
/// The track of poses on a skeleton. Threads: workers. Real-time: no.
[[nodiscard]] DynamicsTrack dynamics_track(const Skeleton& skeleton,
                                           std::span<const Pose> poses,
                                           double frames_per_second,
                                           DanceStretch stretch = {});
/// The track of a recorded clip. Errors: no humanoid, or a joint missing (named); a chest stands in
/// for the upper chest, a foot's tip for its toes.
[[nodiscard]] Expected<DynamicsTrack> dynamics_track(const MotionClip& clip,
                                                     DanceStretch stretch = {});

/// Mean speed of the moving bones in the body's frame, by frame; m/s. What a dancer does, without
/// where it travels and turns.
[[nodiscard]] std::vector<double> body_speeds(const DynamicsTrack& track);

/// Beats of the music that bars are cut by.
struct BarBeats {
    std::vector<double> times;  ///< seconds from the dance's first frame, ascending
    int beats_per_bar = 4;      ///< from the first of them on that lies in the track
};

/// The measures. Of people: 2 to 5 holds a minute, second_spread 2.4-4, body_spread 3.0-4.6, hands
/// still 7-20 %, hand_hits 2.9-4.9.
struct DynamicsMeasures {
    double body_speed = 0.0;        ///< mean of body_speeds(); m/s
    double second_spread = 0.0;     ///< of body speed averaged over 1 s: 95th over 5th percentile
    double body_spread = 0.0;       ///< of body speed: 95th over 10th percentile
    double holds_per_minute = 0.0;  ///< 0.2 s or more under a third of the median body speed
    double hand_speed = 0.0;        ///< mean speed of the hands about the chest; m/s
    double still_hands = 0.0;       ///< share of the time under 0.15 m/s
    double hand_hits = 0.0;         ///< acceleration of the hands: 99th percentile over median
    /// Median over bars of the distance to the most similar other bar, metres: root mean square
    /// over joints of the body and 16 samples a beat. None with less than two bars.
    std::optional<double> nearest_bar;
    /// Share of bars that are 10 cm or more from every one counted before. None as above.
    std::optional<double> distinct_bars;
};
/// Measures a track; `beats`: none are needed for all but the bars. Threads: workers.
[[nodiscard]] DynamicsMeasures measure_dynamics(const DynamicsTrack& track,
                                                const BarBeats& beats = {});

/// A bar of a dance to a part of the music that comes again, and the bar of its first time; seconds
/// from the dance's first frame.
struct RepeatedBar {
    DanceStretch bar;    ///< this time
    DanceStretch first;  ///< the first time
};
/// How alike the bars are that are danced to parts that come again.
struct PartRepeats {
    std::size_t bars = 0;   ///< that lie in the track as their first times do
    std::size_t alike = 0;  ///< of these, those within 10 cm of their first time
    double apart = 0.0;     ///< median distance, metres; 0 without bars
};
/// Measures them by the distance of DynamicsMeasures::nearest_bar, over 64 moments of each bar.
/// Threads: workers.
[[nodiscard]] PartRepeats measure_repeats(const DynamicsTrack& track,
                                          std::span<const RepeatedBar> bars);

/// Averaged by a Gaussian of `deviation` samples; the ends are mirrored.
[[nodiscard]] std::vector<double> gaussian_average(std::span<const double> values,
                                                   double deviation);

/// How body speed follows loudness: the highest correlation of both, each averaged over a second
/// or so (a Gaussian of 0.5 s), of lags of the body from 0 to 1 s. The first 6 s are left out.
/// `speeds`, `loudness_db`: at kDynamicsRate from the same moment. 0 with less than 10 s.
[[nodiscard]] double loudness_correlation(std::span<const double> speeds,
                                          std::span<const double> loudness_db);

}  // namespace raks::motion
