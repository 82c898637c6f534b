// Repeat measures: how large one repeat of a figure is danced, and how much two of them differ.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/dance_metrics.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

// Amplitude: how large one figure is danced.

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

// Repeat distance: how much two repeats of one figure differ. People's basic steps: 11.6 cm (80 %
// within 8 to 15).

inline constexpr std::size_t kShapePhases = 64;  ///< samples of a shape
/// The 19 joints without the hips, which are the origin, and the head, which captures often get
/// wrong.
inline constexpr std::size_t kShapeJoints = kBodyBones.size() - 2;

/// One repeat in the dancer's own frame: places of 17 joints at 64 equal steps of the figure,
/// relative to the point on the floor under the hips, turned so that the pelvis faces +z; metres.
using FigureShape = std::array<std::array<glm::dvec3, kShapeJoints>, kShapePhases>;

/// The shape of one repeat. `count_times`: seconds of each count of the figure and of the next
/// figure's count 1, ascending, at least two. Phases are spaced evenly between counts. None when a
/// count lies outside the track. Threads: workers. Real-time: no.
[[nodiscard]] std::optional<FigureShape> figure_shape(const BodyTrack& track,
                                                      std::span<const double> count_times);

/// Root mean square distance of two shapes over joints and phases; metres.
[[nodiscard]] double rms_distance(const FigureShape& a, const FigureShape& b);

/// The distances of all pairs of repeats; metres.
[[nodiscard]] std::vector<double> repeat_distances(std::span<const FigureShape> repeats);

}  // namespace raks::motion
