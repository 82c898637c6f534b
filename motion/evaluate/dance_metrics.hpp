#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/evaluate/body_track.hpp"

/// How smooth a dance is and how well its feet stand. Places are smoothed by the binomial filter
/// 1-4-6-4-1 over frames first, so figures belong to a frame rate: compare at 60 a second.
namespace raks::motion {

/// What of a track is measured, and against which tempo. Empty vectors: all of it, as it is.
struct MetricFrames {
    /// By frame: belongs to the dance. False for idling and where the capture is wrong; what a
    /// metric would compute from such a frame is left out.
    std::vector<bool> counted;
    /// By frame: tempo danced / tempo learnt, > 0. Speeds are divided by it and jerks by its cube:
    /// the same figure danced faster moves faster, and is no less smooth.
    std::vector<double> pace;

    [[nodiscard]] bool is_counted(std::size_t frame) const noexcept {
        return counted.empty() || counted[frame];
    }
    [[nodiscard]] double pace_at(std::size_t frame) const noexcept {
        return pace.empty() ? 1.0 : pace[frame];
    }
};

/// Third difference of the 19 joints' places; m/s^3.
struct JerkReport {
    double rms = 0.0;
    double p999 = 0.0;  ///< 99.9th percentile over joints and frames
    double highest = 0.0;
    std::vector<double> samples;  ///< joint by joint, for pooling over takes
};
/// Zero for less than 4 frames. Differences whose filter reaches over the ends are left out where
/// `frames` says what is counted: what is cut out of a dance does not stop dead.
/// Threads: workers. Real-time: no.
[[nodiscard]] JerkReport jerk_of(const BodyTrack& track, const MetricFrames& frames = {});
/// Of samples gathered from several tracks.
[[nodiscard]] JerkReport jerk_of_samples(std::vector<double> samples);

/// Contact: toe tip slower than 0.25 m/s and lower than 5 cm over the floor; a contact counts from
/// 4 frames on. The speed that decides is the one seen, whatever the pace.
struct ContactReport {
    double share = 0.0;         ///< of the time in contact, mean of both feet
    std::vector<double> slips;  ///< metres: how far a toe tip moves over the floor in one contact
    std::size_t standing = 0;   ///< of those, contacts that last from the first frame on
    std::vector<double> toe_speeds;  ///< in contact, by frame and foot; m/s
    double slip_median = 0.0;
    double slip_p90 = 0.0;
    double slip_p95 = 0.0;
    double toe_speed_mean = 0.0;  ///< in contact; m/s
    double toe_speed_p95 = 0.0;
    double lowest_toe = 0.0;  ///< the smoothed toe tips' least height over the floor; metres
};
/// `floor_height`: of the floor, metres; none: each foot's own 5th percentile of toe height, for
/// captured motion. Threads: workers. Real-time: no.
[[nodiscard]] ContactReport contacts_of(const BodyTrack& track,
                                        std::optional<double> floor_height = std::nullopt,
                                        const MetricFrames& frames = {});

/// Fills in what follows from `slips` and `toe_speeds`: for contacts of several dances.
void summarize(ContactReport& report);

/// The value below which `share` of the values lie, interpolated between neighbours as numpy does;
/// 0 when empty.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace raks::motion
