// Joint limits: ranges of people's joints.
#pragma once

#include <optional>
#include <string_view>

#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// A joint of a pose that lies beyond what people's joints do.
struct JointExcess {
    std::string_view joint;  ///< "left knee"
    double degrees = 0.0;    ///< its angle
    double lowest = 0.0;     ///< least allowed
    double highest = 0.0;    ///< greatest allowed

    /// Degrees beyond the nearer limit; negative: within.
    [[nodiscard]] double beyond() const noexcept {
        return degrees > highest ? degrees - highest : lowest - degrees;
    }
};

/// The joint furthest beyond its limits; none: all are within. Checked are the bends of knees
/// (never locked: 3 to 150 degrees) and elbows, and the total turns of trunk, neck, hips, ankles,
/// collarbones and wrists. Threads: any. Real-time: yes.
[[nodiscard]] std::optional<JointExcess> worst_joint(const Pose& pose) noexcept;

}  // namespace raks::motion
