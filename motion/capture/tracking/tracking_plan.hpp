// Tracking plan: what every tracker does first: films, clocks, frames, labels, and the body's
// limits.
#pragma once

#include <optional>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/tracking/frame_views.hpp"
#include "motion/capture/tracking/said_views.hpp"
#include "motion/capture/tracking/track_run.hpp"
#include "motion/capture/tracking/tracker_input.hpp"

namespace raks::capture {

/// What a tracker goes through, checked.
struct TrackingPlan {
    const TrackerInput* input = nullptr;
    Films films;
    TimeLine line;
    TrackRunInput run;
    std::vector<std::optional<std::size_t>> classes;  ///< by colour of the observations

    /// The spots of all frames, none of them used.
    [[nodiscard]] FrameViews all_views() const;
    /// Tracks of that many frames in which every marker is lost.
    [[nodiscard]] Tracks empty_tracks() const;
};

/// Whether a tracker can begin without labels.
enum class LabelNeed { needed, not_needed };

/// Plans it. `input` must outlive the plan. Errors: those that track_markers names.
[[nodiscard]] Expected<TrackingPlan> plan_tracking(const TrackerInput& input,
                                                   const TrackerOptions& options,
                                                   LabelNeed labels);

}  // namespace raks::capture
