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

}  // namespace raks::apps
