// Motion clocks: the clocks of a capture's cameras from the joints that they saw.
#pragma once

#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// Whether there is something to tell clocks from: keypoints of every camera, or spots of markers
/// (detections.csv, or labels to find them in the films by) and a rig.
[[nodiscard]] bool has_motion(const CapturePlan& plan);

/// Clocks, and what is doubtful about them.
struct MotionClocks {
    std::vector<capture::Clock> clocks;  ///< of all cameras
    std::vector<std::string> doubts;     ///< one line each
    std::vector<std::string> notes;      ///< what else is worth a line
    double usual_error = 0.01;           ///< seconds
};

/// The clocks of all cameras by motion, where nothing, or too little, was heard. Of a dancer's
/// joints: how they go up and down tells them roughly, then the cameras are placed by the dancer,
/// and the clocks moved until epipolar lines are met. Of markers: by the epipolar lines of the rig,
/// within ten seconds at most. `heard`: clocks that sound has told; the others follow their first
/// one. `within`: as raks capture sync --within. Errors: those of rough_clocks,
/// calibrate_by_dancer, sync_by_motion and of the files.
[[nodiscard]] Expected<MotionClocks> clocks_by_motion(const CapturePlan& plan,
                                                      const std::vector<capture::Clock>& heard,
                                                      double within);

/// Checks clocks that were heard by what moves: a line for each that is off by more than 25 ms, and
/// one that tells how far they are apart. Nothing where motion cannot tell.
[[nodiscard]] std::vector<std::string> check_by_motion(const CapturePlan& plan,
                                                       const std::vector<capture::Clock>& heard);

}  // namespace raks::apps
