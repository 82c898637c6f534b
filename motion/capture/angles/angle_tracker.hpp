// Angle tracker: follows the angles of a body through the films of all cameras (paper, section
// 3.3).
#pragma once

#include <functional>

#include "base/expected.hpp"
#include "motion/capture/angles/angle_filter.hpp"
#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/capture/tracking/marker_tracker.hpp"

namespace raks::capture {

/// How angles are tracked, beside what TrackerOptions says.
struct AngleTrackerOptions {
    BodyKind body = BodyKind::dance;
    AngleFilterOptions filter;  ///< sigma and frames a second are those of TrackerOptions
    /// The body is wrong: each of its bones and markers is off by so much of its length, drawn by
    /// the seed; standard deviation. For measuring what a wrong body does.
    double body_error = 0.0;
    /// Called with the share done, [0, 1]; once it returns false, tracking ends, and the frames
    /// that are not done are lost.
    std::function<bool(double)> progress{};
};

/// What was tracked: places of the markers, and the postures they were found by.
struct AngleStages {
    TrackerStages stages;
    AngleTrack angles;
    BodyShape shape;  ///< of the body that was tracked
};

/// Follows a body through all frames: from the first labels on, forward and backward, by
/// annealed particles (angle_filter.hpp). Where fewer than three tenths of the trunk's markers are
/// seen where the posture has them it is lost, and is looked for in each frame by itself; a limb
/// that is not seen for four frames is sought everywhere. Stretches that were lost are followed
/// once more backward from where the body was found again. At the end each posture is fitted once
/// more between its neighbours, and each marker is triangulated from the spots that lie where the
/// posture has it, or is where the body has it if fewer than two views agree.
///
/// Errors: those of track_markers, and no moment at which 3 markers of the trunk are labelled in
/// two cameras each. Edits that swap or fill do nothing. Same input, same bits, for any number of
/// threads. Threads: any, one a call. Cost: about 300 frames of six cameras a second and core.
[[nodiscard]] Expected<AngleStages> track_angles(const TrackerInput& input,
                                                 const TrackerOptions& options,
                                                 const AngleTrackerOptions& angles);

}  // namespace raks::capture
