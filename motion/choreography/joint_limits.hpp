#pragma once

#include <optional>
#include <string_view>

#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// How far a joint of a pose lies beyond what people's joints do.
struct JointExcess {
    std::string_view joint;  ///< "left knee"
    double degrees = 0.0;    ///< where it is
    double lowest = 0.0;     ///< and where it must be
    double highest = 0.0;

    [[nodiscard]] double beyond() const noexcept {
        return degrees > highest ? degrees - highest : lowest - degrees;
    }
};

/// The joint that is furthest out; none: all within. Bends of knees (never locked: 3 to 150
/// degrees) and elbows; turns, all axes together, of trunk, neck, hips, ankles and wrists.
/// Threads: any. Real-time: yes.
[[nodiscard]] std::optional<JointExcess> worst_joint(const Pose& pose) noexcept;

}  // namespace raks::motion
