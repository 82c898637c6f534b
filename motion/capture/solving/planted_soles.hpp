// Planted soles: where toes and heels stand still on the floor.
#pragma once

#include <vector>

#include "motion/capture/solving/frame_system.hpp"
#include "motion/capture/solving/standing_sole.hpp"

namespace raks::capture {

/// Finds where the soles of a dance stand, and sets FrameSight::planted: 1 where a point of a sole
/// is slow and near the floor, eased over speed and height, so that a foot is neither caught nor
/// let go from one frame to the next. `frames_per_second`: of the states.
void find_planted(const BodyModel& model,
                  const BodyShape& shape,
                  const std::vector<BodyState>& states,
                  double frames_per_second,
                  const StandingSole& standing,
                  std::vector<FrameSight>& sights);

}  // namespace raks::capture
