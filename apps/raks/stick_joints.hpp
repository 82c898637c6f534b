// `raks stick --joint`, `--joints`, `--write-joints`: which joint of a clip is which bone.
#pragma once

#include "apps/raks/commands.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::apps {

/// Puts what a person said of joints into the clip, looks for its joints and says what was guessed
/// or changed; a clip without a body is drawn all the same, with a line that says why it is none.
/// Errors: of the map and the options; joints that the clip has not.
[[nodiscard]] Expected<void> look_for_joints(const StickArguments& arguments,
                                             motion::MotionClip& clip);

/// Writes `arguments.joints_output`: the joints that were found, to be mended. Errors: the
/// system's.
[[nodiscard]] Expected<void> write_joints(const StickArguments& arguments,
                                          const motion::MotionClip& clip);

}  // namespace raks::apps
