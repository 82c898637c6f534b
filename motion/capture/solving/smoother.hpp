// Smoother: the postures of a whole dance, from all that is measured at once.
#pragma once

#include <vector>

#include "motion/capture/solving/frame_system.hpp"

namespace raks::capture {

/// How a dance is smoothed.
struct SmoothOptions {
    double frames_per_second = 60.0;  ///< of the states
    int rounds = 4;                   ///< of Gauss-Newton
    double smoothness = 1.0;          ///< > 1: smaller accelerations are expected
};

/// Improves the postures of a dance: the most likely motion given the markers (each weighted by
/// what it is worth), the limits of joints, feet that stand still where they are planted, and
/// accelerations that are as large as dancers'. No fixed filter: what is measured well is followed
/// closely, what is measured badly is smooth, gaps are bridged. Gauss-Newton over windows of 8 s
/// that overlap by a second. Cost: some 0.5 ms a frame and round.
void smooth(const FrameContext& context,
            const std::vector<FrameSight>& sights,
            const SmoothOptions& options,
            std::vector<BodyState>& states);

}  // namespace raks::capture
