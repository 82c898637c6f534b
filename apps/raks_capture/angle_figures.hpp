// Angle figures: how far tracked postures are from the truth, as lines.
#pragma once

#include <filesystem>

#include "apps/raks_capture/tracking_step.hpp"

namespace raks::apps {

/// Prints mean distances of the joints in the world, angles, lost frames and each limb by itself.
/// `truth`: folder with dance.bvh, of the mannequin. `model`: of the body that was followed.
/// Errors: those of the file.
[[nodiscard]] Expected<void> print_angle_errors(const FollowedMarkers& followed,
                                                const capture::BodyModel& model,
                                                const std::filesystem::path& truth);

/// What people want to know of a body that was followed, a line each: its height, how sure its
/// joints are by the particles' spread, and the stretches in which it is lost.
[[nodiscard]] std::vector<std::string> angle_lines(const FollowedMarkers& followed,
                                                   const capture::BodyModel& model);

}  // namespace raks::apps
