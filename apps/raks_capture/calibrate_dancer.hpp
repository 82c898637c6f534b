// Calibration by the dancer: the cameras of a capture from keypoints, without a board.
#pragma once

#include <optional>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/dancer_rig/dancer_calibration.hpp"
#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::apps {

/// The height of the dancer: as given (> 0), else capture.toml's, else 1.70 m, which is said.
[[nodiscard]] double dancer_height(const CapturePlan& plan, double given);

/// The cameras of the plan as the calibration by the dancer takes them: their lenses from films of
/// the board where every camera has one, else unknown. Errors: those of these films.
[[nodiscard]] Expected<std::vector<capture::DancerCamera>> dancer_cameras(
    const CapturePlan& plan, const std::vector<capture::KeypointFilm>& films);

/// Calibrates from keypoints/*.csv and clocks.toml; without clocks all cameras began at once, which
/// is said. Errors: one camera; those of the files and of calibrate_by_dancer.
[[nodiscard]] Expected<capture::DancerCalibration> calibrate_by_dancer(const CapturePlan& plan,
                                                                       double height);

/// What was found, as a table for people.
[[nodiscard]] std::string dancer_report_text(const capture::DancerCalibration& done);
/// The same as JSON.
[[nodiscard]] std::string dancer_report_json(const capture::DancerCalibration& done);

}  // namespace raks::apps
