// Taken keypoints: joints in the pictures of a capture's cameras that another program found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::apps {

/// Where they lie, and what their files do not say.
struct TakenKeypoints {
    std::vector<std::string> from;     ///< "left=PATH": a camera, and a folder or a table
    std::filesystem::path map;         ///< names of joints (TSV); empty: as their words say
    double pictures_per_second = 0.0;  ///< 0: as the camera's film says
    std::string size;                  ///< "1920x1080"; empty: as the camera's film says
};

/// Reads them and keeps them in the folder of the capture. Errors: not CAMERA=PATH, an unknown
/// camera or one twice; no film, and no size or rate; those of read_foreign_table and of OpenPose's
/// files; a folder without any.
[[nodiscard]] Expected<std::vector<capture::KeypointFilm>> take_keypoints(
    const CapturePlan& plan, const TakenKeypoints& taken);

}  // namespace raks::apps
