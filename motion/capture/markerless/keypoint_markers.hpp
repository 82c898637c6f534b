// Keypoint markers: the joints that a pose network sees, as markers of a body.
#pragma once

#include <span>

#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markers/marker_set.hpp"

namespace raks::capture {

/// The keypoints that a body is solved from, in the order of keypoint_markers(): nose, ears, and of
/// each side shoulder, elbow, wrist, two knuckles, hip, knee, ankle, heel and toes. Eyes and mouth
/// say nothing more.
[[nodiscard]] std::span<const BodyPoint> followed_points() noexcept;

/// The same as markers on the mannequin, each at the joint that it is named after, called as the
/// keypoint is: for points that other programs say are joints.
[[nodiscard]] MarkerSet keypoint_markers();

/// The same, each where a pose network usually takes the joint to be. Where it does with this
/// dancer, the solver finds.
[[nodiscard]] MarkerSet network_markers();

/// The keypoint of the other side of the body; those of the middle are their own.
[[nodiscard]] BodyPoint other_side(BodyPoint point) noexcept;

}  // namespace raks::capture
