#pragma once

#include <array>

#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Makes a sudden change of the motion smooth: the difference between what was shown and what comes
/// decays as a critically damped spring, with its speed at the change (Bollo 2016,
/// "Inertialization: high-performance animation transitions in Gears of War"; half-life form:
/// Holden 2020). Threads: one. Real-time: yes.
class Inertialization {
 public:
    static constexpr double kHalfLife = 0.15;  ///< seconds: jerk at the rest of the dance's level

    /// The motion changes at this moment from `shown` (`shown_before` one hop earlier) to `next`.
    void start(const Pose& shown,
               const Pose& shown_before,
               const Pose& next,
               const Pose& next_before) noexcept;
    void clear() noexcept { is_active_ = false; }

    /// Whether anything is left of the difference then.
    [[nodiscard]] bool is_active(Nanos elapsed) const noexcept;

    /// `pose` with what is left of the difference `elapsed` after the change.
    [[nodiscard]] Pose apply(const Pose& pose, Nanos elapsed) const noexcept;

 private:
    struct Offset {
        glm::vec3 value{};
        glm::vec3 speed{};  ///< per second
    };
    std::array<Offset, kBoneCount> rotations_{};  // rotation vectors
    Offset hips_{};
    bool is_active_ = false;
};

}  // namespace raks::motion
