// Solo arms, danced.
#pragma once

#include <cstdint>

#include "base/realtime.hpp"
#include "motion/figures/solo_arms.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// When and how solo arms are danced.
struct SoloMoment {
    double phase = 0.0;      ///< beats since the dance began
    std::uint64_t seed = 1;  ///< of the choice of patterns; never the same twice running
    float size = 1.0F;       ///< of the way from where hands are at rest, 1: as written
};

/// Puts the arms of the pose where the pattern of the moment has them. Does nothing without
/// patterns. Threads: any. Real-time: yes (a microsecond).
void dance_solo_arms(const SoloArms& solo,
                     const SoloMoment& moment,
                     const Skeleton& skeleton,
                     Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
