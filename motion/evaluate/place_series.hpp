#pragma once

#include <cstddef>
#include <vector>

#include "motion/evaluate/body_track.hpp"

#include <glm/vec3.hpp>

/// One point of the body over time, and what metrics do to it first. Internal to this folder.
namespace raks::motion {

using Places = std::vector<glm::dvec3>;

/// Binomial filter 1-4-6-4-1, ends repeated.
[[nodiscard]] Places smoothed(const Places& places);

/// Central differences, one-sided at the ends; m/s.
[[nodiscard]] std::vector<double> speeds(const Places& places, double frames_per_second);

/// One of the 19 joints, by its index in kBodyBones.
[[nodiscard]] Places joint_places(const BodyTrack& track, std::size_t joint);
[[nodiscard]] Places toe_places(const BodyTrack& track, Side side);
/// Of the point of the foot so far from the ankle towards the toe tip, metres; at most the tip.
[[nodiscard]] Places foot_places(const BodyTrack& track, Side side, double from_ankle);

}  // namespace raks::motion
