// Tracking step: what the markers of a capture are followed by.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/keypoint_step.hpp"
#include "motion/capture/angles/angle_tracker.hpp"
#include "motion/capture/pictures/chroma.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"

namespace raks::apps {

/// All that tracks follow from.
struct TrackingGiven {
    /// Joints that a network saw, instead of spots: of a take without markers.
    std::optional<SeenDancer> dancer{};
    capture::Rig rig{};
    capture::MarkerSet markers{};
    capture::Observations seen{};
    std::vector<capture::Clock> clocks{};
    std::vector<capture::MarkerLabel> labels{};
    std::vector<capture::Edit> edits{};
    capture::TrackerOptions options{};  ///< by capture.toml; the order of the films is not checked
    /// The markers are followed by the angles of a body. None: each by itself.
    std::optional<capture::AngleTrackerOptions> angles{};
};

/// Reads it from the folder of a capture; looks for markers in the films where that is still to be
/// done. `method`: before what capture.toml says. A body that is followed by angles needs no labels
/// where the spots are there. Errors: those of the files, and of seen_by_cameras.
[[nodiscard]] Expected<TrackingGiven> load_tracking(const CapturePlan& plan,
                                                    const std::filesystem::path& labels,
                                                    capture::ChromaForm form,
                                                    std::optional<TrackingMethod> method = {});

/// The same of a take without markers: rig.toml, keypoints, clocks and edits. Errors: those of the
/// files, and of load_keypoint_take.
[[nodiscard]] Expected<TrackingGiven> load_joint_tracking(const CapturePlan& plan);

/// Whether a capture is one without markers: as capture.toml says, or since it has keypoints and
/// nothing of markers.
[[nodiscard]] bool is_without_markers(const CapturePlan& plan);

/// What was followed.
struct FollowedMarkers {
    capture::TrackerStages stages{};              ///< of joints: the last one alone
    std::optional<capture::AngleTrack> angles{};  ///< where a body was followed
    capture::BodyShape shape{};                   ///< likewise
    capture::BodySize size{};                     ///< likewise
    /// Without markers: what the network saw, with its sides put right, before the edits.
    std::optional<capture::KeypointTake> shown{};
    std::vector<std::string> lines{};  ///< likewise: what was put right and passed over
};

/// Follows the markers, or joints, with these edits instead of those that were read. Errors: as
/// track_markers, track_angles and follow_keypoints.
[[nodiscard]] Expected<FollowedMarkers> track_with(const TrackingGiven& given,
                                                   const std::vector<capture::Edit>& edits);

}  // namespace raks::apps
