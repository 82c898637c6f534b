#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"

namespace raks::render {

/// The mannequin's 14 helpers: seven of the left side, then their mirrors.
[[nodiscard]] std::array<HelperJoint, kHelperCount> mannequin_helpers(
    const motion::Skeleton& skeleton) noexcept;

/// Palette index of a helper.
enum class Helper : std::uint8_t {
    left_shoulder_half = motion::kBoneCount,
    left_upper_arm_twist,
    left_elbow_half,
    left_lower_arm_twist,
    left_hip_half,
    left_upper_leg_twist,
    left_knee_half,
    right_shoulder_half,
    right_upper_arm_twist,
    right_elbow_half,
    right_lower_arm_twist,
    right_hip_half,
    right_upper_leg_twist,
    right_knee_half,
};

/// Palette index of the joint on the other side of the body.
[[nodiscard]] constexpr std::size_t mirrored_joint(std::size_t joint) noexcept {
    constexpr std::size_t kBones = motion::kBoneCount;
    constexpr std::size_t kOneSide = kHelperCount / 2;
    if (joint < kBones) {
        return motion::index_of(motion::mirrored(static_cast<motion::Bone>(joint)));
    }
    return joint < kBones + kOneSide ? joint + kOneSide : joint - kOneSide;
}

}  // namespace raks::render
