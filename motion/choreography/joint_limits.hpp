// Joint limits: ranges of people's joints.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion {

/// A joint, or several in a row, whose total angle of rotation from the T-pose is limited.
struct JointLimit {
    std::string_view joint;      ///< "left knee"
    std::array<Bone, 3> in_row;  ///< the first `count` turn together
    std::size_t count = 1;       ///< 1 to 3
    double lowest = 0.0;         ///< degrees
    double highest = 0.0;        ///< degrees

    /// The bones that turn together.
    [[nodiscard]] std::span<const Bone> bones() const noexcept { return {in_row.data(), count}; }
};

/// All limits: the bends of knees (never locked: 3 to 150 degrees) and elbows, and the total turns
/// of trunk, neck, hips, ankles, collarbones and wrists. Threads: any. Real-time: yes.
[[nodiscard]] std::span<const JointLimit> joint_limits() noexcept;

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

/// The joint furthest beyond its limits; none: all are within. Threads: any. Real-time: yes.
[[nodiscard]] std::optional<JointExcess> worst_joint(const Pose& pose) noexcept;

}  // namespace raks::motion
