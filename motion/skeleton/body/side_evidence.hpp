// Side evidence: whether a body's left is on its left, and whether it goes on two legs.
#pragma once

#include "motion/skeleton/body/posed_skeleton.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"

namespace raks::motion {

/// What a body's joints say of where it faces, against where it would face if its left were on its
/// left. Each from -1 (all says the opposite) to 1; 0 where nothing tells.
struct SideEvidence {
    double feet = 0.0;     ///< they point forward
    double knees = 0.0;    ///< they bend forward
    double elbows = 0.0;   ///< they bend backward
    double verdict = 0.0;  ///< all together, weighed by how much each has to say
};

/// `mapping` has hips, legs and arms. No axis is taken for granted: up is from the hip sockets to
/// the upper arms, frame by frame.
[[nodiscard]] SideEvidence side_evidence(const PosedSkeleton& skeleton,
                                         const HumanoidMapping& mapping);

/// Whether the left arm is on the side of the right leg: -1 (in all frames) to 1 (in none).
[[nodiscard]] double arms_beside_legs(const PosedSkeleton& skeleton,
                                      const HumanoidMapping& mapping);

/// Whether it goes on four legs: its trunk lies across its legs, and its hands are where its feet
/// are, in most frames. A person who crawls all the time does, too; no body
/// without hands does.
[[nodiscard]] bool goes_on_four(const PosedSkeleton& skeleton, const HumanoidMapping& mapping);

}  // namespace raks::motion
