// Hand shapes: what fingers do, changed on counts.
#pragma once

#include <array>
#include <cstddef>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Gives each hand a shape; a change is eased. Threads: one. Real-time: yes.
class HandShapes {
 public:
    static constexpr Nanos kEase = std::chrono::milliseconds(150);  ///< of a change

    /// This hand goes over to a shape, from how the last pose that was shown has its fingers.
    void take(Side side,
              HandShape shape,
              StreamTime now,
              const Pose& shown) noexcept RAKS_NONBLOCKING;
    /// The pose with its fingers as they are at that moment. `beat`: of the dance; fingers snap on
    /// the odd ones, cymbals strike on all.
    void apply(StreamTime time, double beat, Pose& pose) const noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kFingerBones = 15;
    struct Hand {
        HandShape shape = HandShape::danced;
        std::array<glm::quat, kFingerBones> from{};  // in the order of Bone
        StreamTime since{-std::chrono::hours(1)};
    };
    std::array<Hand, 2> hands_{};
};

/// Sets the fingers of a hand to a shape at a beat; `danced` leaves them. Threads: any. Real-time:
/// yes.
void set_hand_shape(Side side, HandShape shape, double beat, Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
