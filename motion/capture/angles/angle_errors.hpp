// Angle errors: how far postures are from the truth, where it is known.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "motion/capture/angles/angle_track.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::capture {

/// The joints whose places are compared.
inline constexpr std::array<motion::Bone, 14> kComparedJoints = {
    motion::Bone::hips,
    motion::Bone::neck,
    motion::Bone::left_upper_arm,
    motion::Bone::left_lower_arm,
    motion::Bone::left_hand,
    motion::Bone::right_upper_arm,
    motion::Bone::right_lower_arm,
    motion::Bone::right_hand,
    motion::Bone::left_upper_leg,
    motion::Bone::left_lower_leg,
    motion::Bone::left_foot,
    motion::Bone::right_upper_leg,
    motion::Bone::right_lower_leg,
    motion::Bone::right_foot,
};

/// Limbs, as AngleErrors has them: their last two of the joints.
inline constexpr std::array<std::string_view, 4> kLimbNames = {
    "left arm", "right arm", "left leg", "right leg"};

/// Errors of postures, means over all frames.
struct AngleErrors {
    std::size_t frames = 0;
    std::size_t lost = 0;  ///< frames whose mean distance is over 100 mm, or that were not found
    double mean = 0.0;     ///< distance of the joints in the world; metres
    std::array<double, kComparedJoints.size()> joints{};  ///< likewise, by joint
    std::array<double, 4> limbs{};                        ///< likewise, by kLimbNames
    std::array<double, 4> worst_limbs{};                  ///< the greatest of a frame; metres
    double root = 0.0;                                    ///< angle between the hips; degrees
    double balls = 0.0;   ///< of upper arms and thighs against the hips; degrees
    double hinges = 0.0;  ///< of forearms and shins against these; degrees

    /// Mean over root, four balls and four hinges; degrees.
    [[nodiscard]] double angle() const noexcept {
        return (root + 4.0 * balls + 4.0 * hinges) / 9.0;
    }
};

/// Compares postures with true poses of the mannequin, pose 0 at capture time 0, at the frames of
/// the track that lie within them.
[[nodiscard]] AngleErrors angle_errors(const AngleTrack& track,
                                       const BodyModel& model,
                                       const BodyShape& shape,
                                       std::span<const motion::Pose> truth,
                                       double true_frames_per_second);

}  // namespace raks::capture
