#pragma once

#include <cstddef>

#include "motion/evaluate/dance_metrics.hpp"

namespace raks::motion {

/// How large one figure is danced.
struct Amplitude {
    double hips_travel = 0.0;     ///< largest distance over the floor of two places of the hips; m
    double toe_travel = 0.0;      ///< the same of a toe tip, the larger of both feet; m
    double peak_toe_speed = 0.0;  ///< the faster of both feet, under the filter 1-4-6-4-1; m/s
    /// The same of the foot's point kBall from the ankle: bodies whose feet end elsewhere compare
    /// there.
    double peak_ball_speed = 0.0;
};

/// Metres from the ankle towards the toe tip: where the feet of the salsa takes end.
inline constexpr double kBall = 0.126;

/// Of frames [first, last); `last` <= the track's frames. Speeds are divided by the pace. Frames
/// that are not counted are left out. Threads: workers. Real-time: no (quadratic in the frames).
[[nodiscard]] Amplitude amplitude_of(const BodyTrack& track,
                                     std::size_t first,
                                     std::size_t last,
                                     const MetricFrames& frames = {});

/// Highest speed of a toe tip, m/s, of all frames counted.
[[nodiscard]] double peak_toe_speed(const BodyTrack& track, const MetricFrames& frames = {});

}  // namespace raks::motion
