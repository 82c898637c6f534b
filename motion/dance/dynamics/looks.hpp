// Looks: where a dancer's head turns to.
#pragma once

#include <cstdint>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a dancer is about, for where it looks.
enum class LookFor : std::uint8_t {
    dance,  ///< mostly as the figures have the head, now and then to the audience
    pose,   ///< stands still for the audience
    wait,   ///< looks around
};

/// What it was about before, and what it goes over to.
struct LookChange {
    LookFor before = LookFor::dance;
    LookFor now = LookFor::dance;
    float share = 1.0F;  ///< [0, 1]: of the way from one to the other
};

/// Turns neck and head towards what the dancer looks at: the audience (+z), a side, or nothing in
/// particular; what is behind the shoulders is not looked at. Where it looks changes every few
/// seconds, by the seed. Threads: any. Real-time: yes.
void look(const Skeleton& skeleton,
          StreamTime time,
          std::uint64_t seed,
          const LookChange& change,
          Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
