// Dancer limbs: distances between keypoints that a body keeps while it moves.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::capture {

/// The joints that tell of a dancer's place and posture: shoulders, elbows, wrists, hips, knees,
/// ankles.
inline constexpr std::array<BodyPoint, 12> kMainPoints = {BodyPoint::left_shoulder,
                                                          BodyPoint::right_shoulder,
                                                          BodyPoint::left_elbow,
                                                          BodyPoint::right_elbow,
                                                          BodyPoint::left_wrist,
                                                          BodyPoint::right_wrist,
                                                          BodyPoint::left_hip,
                                                          BodyPoint::right_hip,
                                                          BodyPoint::left_knee,
                                                          BodyPoint::right_knee,
                                                          BodyPoint::left_ankle,
                                                          BodyPoint::right_ankle};

/// A length of the body, alike on both sides.
struct LimbLength {
    double of_height = 0.0;  ///< share of the standing height, of the mannequin
    double deviation = 0.0;  ///< of its logarithm among people and networks
    double bends = 0.0;      ///< standard deviation while one moves; share of the length
};

/// A limb: two of kMainPoints, by index, and its length.
struct DancerLimb {
    std::size_t from = 0;
    std::size_t to = 0;
    std::size_t length = 0;  ///< index in limb_lengths()
};

inline constexpr std::size_t kLimbLengths = 7;  ///< number of lengths

/// Upper arm, forearm, thigh, shin, breadth of shoulders, breadth of hips, side of the trunk.
[[nodiscard]] const std::array<LimbLength, kLimbLengths>& limb_lengths();

/// All limbs.
[[nodiscard]] std::span<const DancerLimb> dancer_limbs() noexcept;

}  // namespace raks::capture
