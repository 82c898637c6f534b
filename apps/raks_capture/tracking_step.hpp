// Tracking step: what the markers of a capture are followed by.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "motion/capture/angles/angle_tracker.hpp"
#include "motion/capture/pictures/chroma.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"

namespace raks::apps {

/// All that tracks follow from.
struct TrackingGiven {
    capture::Rig rig;
    capture::MarkerSet markers;
    capture::Observations seen;
    std::vector<capture::Clock> clocks;
    std::vector<capture::MarkerLabel> labels;
    std::vector<capture::Edit> edits;
    capture::TrackerOptions options;  ///< by capture.toml; the order of the films is not checked
    /// The markers are followed by the angles of a body. None: each by itself.
    std::optional<capture::AngleTrackerOptions> angles;
};

/// Reads it from the folder of a capture; looks for markers in the films where that is still to be
/// done. `method`: before what capture.toml says. A body that is followed by angles needs no labels
/// where the spots are there. Errors: those of the files, and of seen_by_cameras.
[[nodiscard]] Expected<TrackingGiven> load_tracking(const CapturePlan& plan,
                                                    const std::filesystem::path& labels,
                                                    capture::ChromaForm form,
                                                    std::optional<TrackingMethod> method = {});

/// What was followed.
struct FollowedMarkers {
    capture::TrackerStages stages;
    std::optional<capture::AngleTrack> angles;  ///< where a body was followed
    capture::BodyShape shape;                   ///< likewise
    capture::BodySize size;                     ///< likewise
};

/// Follows the markers with these edits instead of those that were read. Errors: as
/// track_markers and track_angles.
[[nodiscard]] Expected<FollowedMarkers> track_with(const TrackingGiven& given,
                                                   const std::vector<capture::Edit>& edits);

}  // namespace raks::apps
