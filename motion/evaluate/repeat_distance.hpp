#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "motion/evaluate/body_track.hpp"

#include <glm/vec3.hpp>

/// How much two repeats of one figure differ. People's basics: 11.6 cm (80 % within 8 to 15).
namespace raks::motion {

inline constexpr std::size_t kShapePhases = 64;
/// The 19 joints without the hips, which are the origin, and the head, which captures get wrong.
inline constexpr std::size_t kShapeJoints = kBodyBones.size() - 2;

/// One repeat as the dancer's own eyes see it: places of 17 joints at 64 equal steps of the figure,
/// from over the floor under the hips, turned so that the pelvis faces +z; metres.
using FigureShape = std::array<std::array<glm::dvec3, kShapeJoints>, kShapePhases>;

/// `count_times`: seconds of each count of the figure and of the next figure's count 1, ascending,
/// at least two. Phases lie evenly between counts. Nothing when a count lies outside the track.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::optional<FigureShape> figure_shape(const BodyTrack& track,
                                                      std::span<const double> count_times);

/// Root mean square over joints and phases of the distance between both; metres.
[[nodiscard]] double rms_distance(const FigureShape& a, const FigureShape& b);

/// Of every pair of repeats.
[[nodiscard]] std::vector<double> repeat_distances(std::span<const FigureShape> repeats);

}  // namespace raks::motion
