#pragma once

#include <array>
#include <span>

#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// What a captured body with fewer joints than ours lacks, by rule: a trunk that bends in one
/// place, feet without toes.
namespace raks::motion {

/// Whether a bone turns against its parent by more than half a degree; of at least one pose.
/// Threads: any. Real-time: no.
[[nodiscard]] bool ever_moves(std::span<const Pose> poses, Bone bone);

/// Share of the trunk's rotation that its lower joint takes where only the sum is known: on
/// captured dances right to 3.5 degrees, where a rigid trunk is wrong by 11.6 (measured on takes
/// with two joints).
inline constexpr double kLowerTrunkShare = 0.73;

/// Spreads the rotation of a trunk with one joint over spine and chest; the chest's orientation
/// stays. Such a trunk is one of which a single bone moves, or whose spine and chest always turn
/// alike: a converter halved the rotation. Returns whether it was one; others stay as they are.
/// Threads: any. Real-time: no.
bool spread_trunk(std::span<Pose> poses);

/// Rolls feet over their balls where toes never bend: a rigid foot that is raised stands on the tip
/// of its toes, one with toes on its ball, and so turns further for the same height of the ankle.
/// `feet`: by frame and Side, over the floor; feet in the air stay as they are, toes are bent where
/// the foot is planted (motion/dance/baking/foot_lock.hpp). Returns whether the toes never bend;
/// else nothing changes. Threads: any. Real-time: no.
bool roll_heels(const Skeleton& skeleton,
                std::span<const std::array<SourceFoot, 2>> feet,
                std::span<Pose> poses);

}  // namespace raks::motion
