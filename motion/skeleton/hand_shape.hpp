// Hand shape: fingers from open to closed.
#pragma once

#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Sets the fingers of a hand, from open and flat (`fist` 0) to a fist with the thumb beside it
/// (1).
void set_hand_shape(Side side, double fist, Pose& pose) noexcept;

}  // namespace raks::motion
