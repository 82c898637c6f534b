#pragma once

#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Fingers softly bent, more toward the little finger, as a dancer's: captured clips leave them
/// straight. Threads: any. Real-time: yes.
void relax_hands(Pose& pose) noexcept;

}  // namespace raks::motion
