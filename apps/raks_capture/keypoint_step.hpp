// Keypoint step: the places of a dancer's joints from what a pose network saw in all films.
#pragma once

#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::apps {

/// Keypoints of all films, and the same on one clock.
struct SeenDancer {
    std::vector<capture::KeypointFilm> films;  ///< in the plan's order
    std::vector<capture::Clock> clocks;        ///< likewise
    capture::KeypointTake take;
};

/// Reads keypoints/*.csv and clocks.toml of a capture; without the latter all cameras began at
/// once, which is said. The take has the rate of the fastest film. Errors: fewer than two cameras;
/// a camera without a clock; those of the files.
[[nodiscard]] Expected<SeenDancer> load_keypoint_take(const CapturePlan& plan);

/// The cameras of rig.toml in the plan's order. Errors: those of the file; a rig without a camera
/// of the plan.
[[nodiscard]] Expected<capture::Rig> load_rig_in_order(const CapturePlan& plan);

/// Whether all markers of the tracks have the names of keypoints.
[[nodiscard]] bool is_of_keypoints(const capture::Tracks& tracks);

/// The markers that tracks are of: keypoints where all have the names of such, else the capture's.
[[nodiscard]] Expected<capture::MarkerSet> markers_of(const CapturePlan& plan,
                                                      const capture::Tracks& tracks);

}  // namespace raks::apps
