// Relaxed hands.
#pragma once

#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Bends the fingers softly, more toward the little finger, as a dancer's: captured clips leave
/// them straight. Threads: any. Real-time: yes.
void relax_hands(Pose& pose) noexcept;

}  // namespace raks::motion
