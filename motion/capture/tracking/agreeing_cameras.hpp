// Agreeing cameras: following the markers without the cameras that disagree with the others.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "motion/capture/tracking/camera_moves.hpp"
#include "motion/capture/tracking/tracking_plan.hpp"

namespace raks::capture {

/// What was followed, and what of the cameras did not count.
struct Followed {
    std::vector<TrackedMarker> tracked;  ///< frames x markers, row-major
    std::vector<CameraMove> moves;
    std::size_t call = 0;  ///< of `follow`, from 0, whose result it is
};

/// Follows all markers through all frames, as run_tracker does.
using FollowMarkers =
    std::function<std::vector<TrackedMarker>(const TrackRunInput&, FrameViews&, std::size_t)>;

/// Follows the markers by `follow`; as long as a camera disagrees, again without it. Two cameras
/// stay. Against markers that were followed without it, a camera must disagree still, or it was the
/// others' fault.
[[nodiscard]] Followed follow_what_agrees(const TrackingPlan& plan, const FollowMarkers& follow);

}  // namespace raks::capture
