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
    BodyModel body{BodyKind::dance};
    AngleFilterOptions filter;  ///< sigma and frames a second are those of TrackerOptions
    /// Lengths of the body and places of its markers are fitted to the first seconds before all is
    /// followed; else they are those of a mannequin as tall.
    bool fits_body = true;
    /// The body that is begun with is wrong: each of its bones and markers is off by so much of its
    /// length, drawn by the seed; standard deviation. For measuring what a wrong body does.
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
    BodySize size;    ///< likewise
};

/// Follows a body through all frames: from the first labels on, or where there are none from the
/// first posture that the spots of the first 10 seconds tell, forward and backward, by annealed
/// particles (angle_filter.hpp). Where fewer than three tenths of the trunk's markers are seen
/// where the posture has them it is lost, and is looked for in each frame by itself; a limb that is
/// not seen for four frames is sought everywhere. Stretches that were lost are followed once more
/// backward from where the body was found again. At the end each posture is fitted once more
/// between its neighbours, and each marker is triangulated from the spots that lie where the
/// posture has it, or is where the body has it if fewer than two views agree.
///
/// The body is that of the told height. It is followed for 3.4 seconds, in which its size is
/// fitted, twice; then through all.
///
/// Errors: those of track_markers but for labels, those of posture_by_labels, and neither labels of
/// 3 markers of the trunk in two cameras at one moment nor a body that is found without. Edits that
/// swap or fill do nothing. Same input, same bits, for any number of threads. Threads: any, one a
/// call. Cost: about 300 frames of six cameras a second and core.
[[nodiscard]] Expected<AngleStages> track_angles(const TrackerInput& input,
                                                 const TrackerOptions& options,
                                                 const AngleTrackerOptions& angles);

}  // namespace raks::capture
