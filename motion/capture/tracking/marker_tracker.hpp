// Marker tracker: follows all markers through the films of all cameras (paper, sections 3.1 and
// 3.2).
#pragma once

#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/tracking/camera_moves.hpp"
#include "motion/capture/tracking/tracker_input.hpp"

namespace raks::capture {

/// The same tracks at three stages: what a figure of the first two is compared with.
struct TrackerStages {
    Tracks triangulated;  ///< each frame by itself
    Tracks filtered;      ///< by Kalman's filter, as a live tracker would have them
    Tracks smoothed;      ///< with what follows known, too; gaps up to 0.5 s filled; with flags
    std::vector<CameraMove> moves;  ///< cameras that disagree, and when; they do not count then
};

/// Follows the markers. In each frame every marker is predicted, matched with spots of its colour
/// near its projection (chi-square gate), triangulated from all views that agree, and filtered. A
/// marker that fewer than two views see goes on by its velocity for two frames, then with the other
/// markers; after five it is sought among the unused spots of its colour. A place that the body
/// does not allow (distance_limits.hpp) is not believed: of the markers concerned the one that most
/// of its neighbours contradict is given up and sought again. At the end each track is smoothed
/// (Rauch, Tung and Striebel); gaps of 0.2 s and longer are flagged, those of 0.5 s are not filled.
/// A camera that disagrees with the others (camera_moves.hpp) is left out where it does, and the
/// markers are followed again without it, the worst camera first.
///
/// Errors, one line each: what check_rig refuses; a film whose camera the rig has not, or without a
/// clock; a label whose camera or marker there is not; no moment at which two cameras film; no
/// marker that is labelled in two cameras at one moment; films that check_view_order refuses; a
/// world in which the dancer is larger or smaller than said by a quarter. Same input, same bits.
/// Threads: any, one a call. Cost: about 2,000 frames of six cameras a second, again for each
/// camera that was moved.
[[nodiscard]] Expected<TrackerStages> track_markers(const TrackerInput& input,
                                                    const TrackerOptions& options);

}  // namespace raks::capture
