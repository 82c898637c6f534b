// Breath: chest and shoulders of who dances calmly, or not at all.
#pragma once

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Breathes: the chest opens, the shoulders rise, by a degree or so. It is seen where the dance is
/// calm and most where it stands still; what is danced fully hides it. The time alone says where in
/// a breath it is. Threads: one. Real-time: yes.
class Breath {
 public:
    /// One hop. `energy`: how much is danced; `is_still`: the dance stands.
    void advance(float energy, bool is_still) noexcept RAKS_NONBLOCKING;
    /// The pose with the breath of that moment.
    void apply(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    float depth_ = 0.0F;  // [0, 1]
};

}  // namespace raks::motion
