// VPD: poses of MikuMikuDance.
#pragma once

#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/formats/mmd/mmd_motion.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// The first bytes of a VPD.
inline constexpr std::string_view kVpdMark = "Vocaloid Pose Data file";

/// Reads a pose: text in code page 932, a block of name, place and turn for each bone, and of name
/// and weight for each morph. The inverse kinematics is on, as on a model that was just loaded.
/// Bones and morphs that are not known are counted in a warning. Errors, one line with its number:
/// not a VPD, a block that does not end, a number that is missing, none or not finite. Threads:
/// workers. Real-time: no.
[[nodiscard]] Expected<MmdMotion> read_vpd(std::string_view text);

/// The same as a clip of one frame; `name` stands for the file in errors.
[[nodiscard]] Expected<MotionClip> parse_vpd(std::string_view text,
                                             std::string_view name,
                                             double arm_angle = kMmdArmAngle);

}  // namespace raks::motion
