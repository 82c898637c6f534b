#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/evaluate/body_track.hpp"

/// Dance metrics: how smooth a dance is and how well its feet stand. Places are first smoothed by
/// the binomial filter 1-4-6-4-1 over frames, so results depend on the frame rate: compare at 60 a
/// second.
namespace raks::motion {

/// Which frames of a track count, and at which pace. Empty vectors: all count, at pace 1.
struct MetricFrames {
    /// By frame: belongs to the dance. False while idling and where the capture is wrong; values
    /// that depend on such a frame are left out.
    std::vector<bool> counted;
    /// By frame: tempo danced / tempo learnt, > 0. Speeds are divided by it and jerks by its cube,
    /// because a figure danced faster moves faster without being less smooth.
    std::vector<double> pace;

    /// Whether a frame counts.
    [[nodiscard]] bool is_counted(std::size_t frame) const noexcept {
        return counted.empty() || counted[frame];
    }
    /// The pace at a frame.
    [[nodiscard]] double pace_at(std::size_t frame) const noexcept {
        return pace.empty() ? 1.0 : pace[frame];
    }
};

/// Jerk: third difference of the 19 joints' places; m/s^3.
struct JerkReport {
    double rms = 0.0;             ///< over joints and frames
    double p999 = 0.0;            ///< 99.9th percentile over joints and frames
    double highest = 0.0;         ///< over joints and frames
    std::vector<double> samples;  ///< joint by joint, for pooling over takes
};
/// Measures the jerk; zero for fewer than 4 frames. Where `frames` says what counts, differences
/// whose filter reaches over the ends of a counted stretch are left out, since a dance that is cut
/// does not really stop there. Threads: workers. Real-time: no.
[[nodiscard]] JerkReport jerk_of(const BodyTrack& track, const MetricFrames& frames = {});
/// The report of samples gathered from several tracks.
[[nodiscard]] JerkReport jerk_of_samples(std::vector<double> samples);

/// Contacts of the toes: the tip is slower than 0.25 m/s and lower than 5 cm over the floor, for at
/// least 4 frames. The speed that decides is the actual one, not divided by the pace.
struct ContactReport {
    double share = 0.0;         ///< share of the time in contact, mean of both feet
    std::vector<double> slips;  ///< by contact: how far the toe tip moves over the floor; metres
    std::size_t standing = 0;   ///< how many contacts last from the first frame on
    std::vector<double> toe_speeds;  ///< in contact, by frame and foot; m/s
    double slip_median = 0.0;        ///< of `slips`
    double slip_p90 = 0.0;           ///< 90th percentile of `slips`
    double slip_p95 = 0.0;           ///< 95th percentile of `slips`
    double toe_speed_mean = 0.0;     ///< in contact; m/s
    double toe_speed_p95 = 0.0;      ///< 95th percentile of `toe_speeds`
    double lowest_toe = 0.0;  ///< least height of the smoothed toe tips over the floor; metres
};
/// Measures the contacts. `floor_height` in metres; none: each foot's own 5th percentile of toe
/// height, for captured motion. Threads: workers. Real-time: no.
[[nodiscard]] ContactReport contacts_of(const BodyTrack& track,
                                        std::optional<double> floor_height = std::nullopt,
                                        const MetricFrames& frames = {});

/// Computes the statistics of `slips` and `toe_speeds`, for contacts joined from several dances.
void summarize(ContactReport& report);

// Played at pace: what the jerk of a dance would measure at another tempo. Divided by pace^3 it
// would stay the same but for the filter, which cuts at a fixed frequency and so takes more off a
// faster dance.

/// Paces (tempo / learnt tempo) that are compared; the dancer's range.
inline constexpr std::array<double, 7> kJudgedPaces = {0.75, 0.85, 0.95, 1.0, 1.1, 1.2, 1.4};

/// The dance `pace` times as fast, at the same frames a second (Catmull-Rom); pace > 0. Threads:
/// any. Real-time: no.
[[nodiscard]] BodyTrack played_at_pace(const BodyTrack& track, double pace);
/// Which frames of it count. `frames`: of the original track with `count` frames, without paces.
[[nodiscard]] MetricFrames frames_at_pace(const MetricFrames& frames,
                                          std::size_t count,
                                          double pace);

/// Sum of squared jerks, to be added up over takes.
struct JerkSquares {
    double sum = 0.0;    ///< of the squares
    double count = 0.0;  ///< of the samples

    /// Root mean square; 0 without samples.
    [[nodiscard]] double rms() const noexcept;
};
using JerkByPace = std::array<JerkSquares, kJudgedPaces.size()>;

/// Jerk (divided by pace^3) of the dance played at each of kJudgedPaces. Threads: workers.
/// Real-time: no.
[[nodiscard]] JerkByPace jerk_by_pace(const BodyTrack& track, const MetricFrames& frames);

}  // namespace raks::motion
