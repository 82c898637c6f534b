// Trunk chain: the joints of a spine.
#pragma once

#include <vector>

#include "motion/skeleton/body/posed_skeleton.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"

namespace raks::motion {

/// The joints that bend between the hips and what carries both arms, that one included, from
/// below: twist joints and those without a length of their own are passed over. Empty where hips
/// or upper arms are not known. `skeleton`: of the clip.
[[nodiscard]] std::vector<int> trunk_chain(const MotionClip& clip,
                                           const PosedSkeleton& skeleton,
                                           const HumanoidMapping& mapping);

}  // namespace raks::motion
