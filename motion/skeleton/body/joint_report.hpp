// Joint report: the joints of a clip, and what was found of them, as text for people.
#pragma once

#include <optional>
#include <string>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// A joint's name as a message shows it: printable, not too long; a number where it has none.
[[nodiscard]] std::string shown_joint(const MotionClip& clip, std::size_t joint);

/// The joints in their order, not too many of them: "a, b, c, ... (20 in all)".
[[nodiscard]] std::string shown_joints(const MotionClip& clip);

/// Why this is no body, in one line: what of hips, legs and arms is found and what is missing, and
/// the joints of the clip. None: nothing is missing.
[[nodiscard]] std::optional<Error> missing_joints(const MotionClip& clip,
                                                  const HumanoidMapping& mapping);

/// A joint map of what was found, to be mended by hand: bones that are missing stand in it with an
/// empty name, the joints of the clip in comments below. TOML text that read_joint_map reads.
[[nodiscard]] std::string joint_map_text(const MotionClip& clip, const HumanoidMapping& mapping);

}  // namespace raks::motion
