#pragma once

#include <cstddef>
#include <vector>

#include "motion/evaluate/body_track.hpp"

#include <glm/vec3.hpp>

/// Place series: one point of the body by frame, and the filters of the metrics. Internal to this
/// folder.
namespace raks::motion {

/// Places of one point by frame; metres, world.
using Places = std::vector<glm::dvec3>;

/// Binomial filter 1-4-6-4-1, ends repeated.
[[nodiscard]] Places smoothed(const Places& places);

/// Speed by frame: central differences, one-sided at the ends; m/s.
[[nodiscard]] std::vector<double> speeds(const Places& places, double frames_per_second);

/// Places of one of the 19 joints, by its index in kBodyBones.
[[nodiscard]] Places joint_places(const BodyTrack& track, std::size_t joint);
/// Places of a toe tip.
[[nodiscard]] Places toe_places(const BodyTrack& track, Side side);
/// Places of the point `from_ankle` metres from the ankle towards the toe tip, at most the tip.
[[nodiscard]] Places foot_places(const BodyTrack& track, Side side, double from_ankle);

}  // namespace raks::motion
