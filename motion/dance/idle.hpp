// Idle: standing while there is no music.
#pragma once

#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Standing while there is nothing to dance to: relaxed arms, slow shifts of the weight, breathing;
/// both feet planted. A function of time alone, never quite the same and never frozen.
/// Threads: any. Real-time: yes.
[[nodiscard]] Pose idle_pose(const Skeleton& skeleton, StreamTime time) noexcept;

}  // namespace raks::motion
