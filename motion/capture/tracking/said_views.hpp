// Said views: what labels and edits say, at the frames of the tracks.
#pragma once

#include <vector>

#include "base/expected.hpp"
#include "motion/capture/tracking/track_run.hpp"
#include "motion/capture/tracking/tracker_input.hpp"

namespace raks::capture {

/// The films in order of the input, as the tracker uses them.
struct Films {
    std::vector<std::size_t> cameras;  ///< by film: its camera in the rig
    std::vector<Clock> clocks;         ///< by film
};

/// The moments that two or more films cover.
struct TimeLine {
    double first = 0.0;  ///< capture time of frame 0; seconds
    std::size_t frame_count = 0;
    double frames_per_second = 60.0;
};

/// Adds what a person said to a run: labels and edits. Errors: a marker or camera that there is
/// not, a picture that the film lacks, a pixel outside of the picture.
[[nodiscard]] Expected<void> read_said(const TrackerInput& input,
                                       const Films& films,
                                       const TimeLine& line,
                                       TrackRunInput& run);

}  // namespace raks::capture
