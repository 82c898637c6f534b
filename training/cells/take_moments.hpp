#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// Joints by whose places and speeds two moments are compared, those of the left before their
/// counterparts.
inline constexpr std::array<Bone, 15> kMomentBones = {Bone::hips,
                                                      Bone::chest,
                                                      Bone::neck,
                                                      Bone::left_upper_arm,
                                                      Bone::right_upper_arm,
                                                      Bone::left_lower_arm,
                                                      Bone::right_lower_arm,
                                                      Bone::left_hand,
                                                      Bone::right_hand,
                                                      Bone::left_lower_leg,
                                                      Bone::right_lower_leg,
                                                      Bone::left_foot,
                                                      Bone::right_foot,
                                                      Bone::left_toes,
                                                      Bone::right_toes};

/// How a body stands and moves at one frame, seen from the floor under its hips, heading as they
/// do: x left, y up, z forward; metres, seconds, radians.
struct TakeMoment {
    std::array<glm::dvec3, kMomentBones.size()> places{};      ///< by kMomentBones
    std::array<glm::dvec3, kMomentBones.size()> velocities{};  ///< of these places
    glm::dvec2 hips_velocity{};                                ///< left, forward
    double turning = 0.0;                                      ///< of the hips, a second
    std::array<bool, 2> is_planted{};                          ///< by Side

    /// Mean of the speeds of the joints about the hips.
    [[nodiscard]] double speed() const noexcept;
};

/// The moments of all frames of a clip. `planted`: by Side and frame.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<TakeMoment> moments_of(std::span<const Pose> poses,
                                                 double frames_per_second,
                                                 const Skeleton& body,
                                                 const std::array<std::vector<bool>, 2>& planted);

/// The mirror image.
[[nodiscard]] TakeMoment mirrored(const TakeMoment& moment) noexcept;

/// How far two moments are apart, centimetres: the root mean square over the joints of the places'
/// distance; a tenth of that of the velocities', of the hips' and a twentieth of the turning's in
/// degrees, all as squares. Feet of which one is planted in one moment alone add 3.
[[nodiscard]] double distance(const TakeMoment& a, const TakeMoment& b) noexcept;

}  // namespace raks::motion
