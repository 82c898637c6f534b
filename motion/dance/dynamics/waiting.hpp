// Waiting: what a dancer does who stands and does not dance.
#pragma once

#include <cstdint>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// A moment of waiting.
struct WaitingMoment {
    StreamTime time{};
    std::uint64_t seed = 1;
    float felt = 0.0F;     ///< [0, 1]: how much of the beat is felt already
    double beat = 0.0;     ///< beats of the music
    double bowing = -1.0;  ///< seconds since a bow began; negative: there is none
};

/// Seconds that a bow takes.
inline constexpr double kBowSeconds = 2.2;

/// Makes one who stands (Standing) alive: shifts the weight, shakes out the hands now and then,
/// nods and gives in the knees to a beat that is felt, bows. The feet stay. Threads: any.
/// Real-time: yes.
void wait(const Skeleton& skeleton,
          const WaitingMoment& moment,
          Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
