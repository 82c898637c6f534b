#pragma once

#include "motion/choreography/body_angles.hpp"
#include "motion/choreography/foot_plan.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// Trunk, legs and arms of one frame, solved in closed form: a frame does not depend on the one
/// before.
namespace raks::motion {

/// Longest reach of a leg as a share of its length: the knee keeps 10 degrees of bend.
inline constexpr double kLegReach = 0.996;

/// Thigh and shin of a skeleton, metres.
struct LegLengths {
    double thigh = 0.0;  ///< from hip to knee
    double shin = 0.0;   ///< from knee to ankle

    /// Longest distance from hip to ankle.
    [[nodiscard]] double reach() const noexcept { return kLegReach * (thigh + shin); }
    /// Distance from hip joint to ankle at this bend of the knee (radians, 0: straight).
    [[nodiscard]] double at_bend(double bend) const noexcept;
};
/// Those of a skeleton; both legs are alike.
[[nodiscard]] LegLengths leg_lengths(const Skeleton& skeleton) noexcept;

/// Sets pelvis, spine, neck and head of the pose; `hips`: place of the hips, metres.
void set_trunk(const Skeleton& skeleton,
               const BodyFrame& frame,
               const glm::dvec3& hips,
               Pose& pose) noexcept;

/// Sets thigh, shin, foot and toes of one side, from the pose's pelvis to the planned foot, whose
/// heel is lifted by `extra_pitch` (radians). The knee points where foot (0.7) and pelvis (0.3) do.
/// A swinging foot out of reach is pulled nearer. Sets foot_contact.
void set_leg(const Skeleton& skeleton,
             Side side,
             const PlannedFoot& foot,
             double extra_pitch,
             Pose& pose) noexcept;

/// Sets collarbone, arm, hand and fingers of one side, on the pose's trunk.
void set_arm(const Skeleton& skeleton, Side side, const BodyFrame& frame, Pose& pose) noexcept;

/// Place of the hip joint of one side for this pelvis; metres, world.
[[nodiscard]] glm::dvec3 hip_joint(const Skeleton& skeleton,
                                   Side side,
                                   const glm::dquat& pelvis,
                                   const glm::dvec3& hips) noexcept;

/// Centre of mass of a body; metres, world (segments' shares of mass: Winter 2009, table 4.1).
[[nodiscard]] glm::dvec3 centre_of_mass(const Skeleton& skeleton, const Pose& pose) noexcept;

}  // namespace raks::motion
