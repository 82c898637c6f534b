#pragma once

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Brings hands and forearms that are in trunk, thighs or head out of them, by the arm alone:
/// repeats vary arms and body each by itself, and arms that hang would pass through the hips.
/// Softly, from 3.5 cm before they touch: what moves smoothly still does. Threads: any. Real-time:
/// yes.
void clear_hands(const Skeleton& skeleton, Pose& pose) noexcept;

}  // namespace raks::motion
