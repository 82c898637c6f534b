// Amplitude: how large one figure is danced.
#pragma once

#include <cstddef>

#include "motion/evaluate/dance_metrics.hpp"

namespace raks::motion {

/// Size of the movements in one stretch of a dance.
struct Amplitude {
    /// Largest distance over the floor between two places of the hips; metres
    double hips_travel = 0.0;
    double toe_travel = 0.0;      ///< the same of a toe tip, the larger of both feet; metres
    double peak_toe_speed = 0.0;  ///< the faster foot, filtered by 1-4-6-4-1; m/s
    /// Peak speed of the point kBall from the ankle, m/s: comparable between bodies whose feet have
    /// different lengths.
    double peak_ball_speed = 0.0;
};

/// Distance from the ankle towards the toe tip, metres: the length of the feet in the salsa takes.
inline constexpr double kBall = 0.126;

/// Amplitude over frames [first, last); `last` <= the track's frames. Speeds are divided by the
/// pace. Frames that are not counted are left out. Threads: workers. Real-time: no (quadratic in
/// the frames).
[[nodiscard]] Amplitude amplitude_of(const BodyTrack& track,
                                     std::size_t first,
                                     std::size_t last,
                                     const MetricFrames& frames = {});

/// Highest speed of a toe tip over all counted frames, divided by the pace; m/s.
[[nodiscard]] double peak_toe_speed(const BodyTrack& track, const MetricFrames& frames = {});

}  // namespace raks::motion
