#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "motion/evaluate/body_track.hpp"

#include <glm/vec3.hpp>

/// Repeat distance: how much two repeats of one figure differ. People's basic steps: 11.6 cm (80 %
/// within 8 to 15).
namespace raks::motion {

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
