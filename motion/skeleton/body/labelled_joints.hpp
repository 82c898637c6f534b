// Labelled joints: what a person said of a clip's joints, checked against the clip.
#pragma once

#include "base/expected.hpp"
#include "motion/skeleton/body/parent_tree.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// The joints that MotionClip::labels name. `tree`: of the clip's joints. Errors, in one line with
/// where it was said: a joint that the clip has not (with the nearest) or has twice; a bone that
/// does not hang on the nearest said one that it is a part of.
[[nodiscard]] Expected<HumanoidMapping> labelled_joints(const MotionClip& clip,
                                                        const ParentTree& tree);

}  // namespace raks::motion
