// Inertialization: hides a sudden change of motion.
#pragma once

#include <array>

#include "base/realtime.hpp"
#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// Smooths a sudden change of motion: the difference between what was shown and what comes decays
/// like a critically damped spring that starts with the difference's own speed (Bollo 2016,
/// "Inertialization: high-performance animation transitions in Gears of War"; half-life form:
/// Holden 2020). Threads: one. Real-time: yes.
class Inertialization {
 public:
    /// Seconds; the jerk is then that of the rest of the dance
    static constexpr double kHalfLife = 0.15;

    /// The motion changes at this moment from `shown` to `next`; the other two poses are of one hop
    /// earlier.
    void start(const Pose& shown,
               const Pose& shown_before,
               const Pose& next,
               const Pose& next_before) noexcept RAKS_NONBLOCKING;
    /// Drops the difference.
    void clear() noexcept { is_active_ = false; }

    /// Whether anything is left of the difference `elapsed` after the change.
    [[nodiscard]] bool is_active(Nanos elapsed) const noexcept RAKS_NONBLOCKING;

    /// `pose` with what is left of the difference `elapsed` after the change.
    [[nodiscard]] Pose apply(const Pose& pose, Nanos elapsed) const noexcept RAKS_NONBLOCKING;

 private:
    struct Offset {
        glm::vec3 value{};
        glm::vec3 speed{};  ///< per second
    };
    std::array<Offset, kBoneCount> rotations_{};  // rotation vectors, radians
    Offset hips_{};
    bool is_active_ = false;
};

}  // namespace raks::motion
