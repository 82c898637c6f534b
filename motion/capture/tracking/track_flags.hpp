// Track flags: from what the tracker saw to smooth tracks, and what is doubtful about them.
#pragma once

#include <vector>

#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/tracking/track_run.hpp"

namespace raks::capture {

/// Fills the tracks of all three stages, which are empty but for their size, from what was tracked
/// (frames x markers); the last gets flags. `smoothing`: acceleration of the smoother, m/s^2.
void fill_stages(const std::vector<TrackedMarker>& tracked,
                 const TrackRunInput& run,
                 double smoothing,
                 Tracks& triangulated,
                 Tracks& filtered,
                 Tracks& smoothed);

}  // namespace raks::capture
