// Keypoint files: where the joints that a camera saw are kept in the folder of a capture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::apps {

/// keypoints/CAMERA.csv of a capture.
[[nodiscard]] std::filesystem::path keypoint_file(const CapturePlan& plan,
                                                  const std::string& camera);

/// Writes what a camera saw there; the folder is made where there is none. Errors: the system's.
[[nodiscard]] Expected<void> keep_keypoints(const CapturePlan& plan,
                                            const capture::KeypointFilm& seen);

/// What all cameras of the plan saw, in its order. Errors: one is not there (raks capture keypoints
/// first), those of the files.
[[nodiscard]] Expected<std::vector<capture::KeypointFilm>> load_keypoints(const CapturePlan& plan);

}  // namespace raks::apps
