// Collar bones: how far shoulders rise and differ.
#pragma once

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Keeps the collar bones within what people's do: a shoulder's joint rises at most 2 cm over the
/// base of the neck, along the spine, and the joints of both sides differ by 8 cm at most (at a leg
/// of 0.83 m; a body whose shoulders lie higher at rest may raise them by half a centimetre). It
/// begins softly, so that smooth motion stays smooth. The arms keep their directions and go with
/// their shoulders. Threads: any. Real-time: yes.
void limit_collar_bones(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
