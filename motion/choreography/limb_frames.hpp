#pragma once

#include "motion/choreography/body_angles.hpp"
#include "motion/choreography/foot_plan.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

/// Legs and arms of one frame, solved exactly: no memory of the frame before.
namespace raks::motion {

/// Longest reach of a leg as a share of its length: the knee keeps 10 degrees of bend.
inline constexpr double kLegReach = 0.996;

/// Thigh and shin of a skeleton, metres.
struct LegLengths {
    double thigh = 0.0;
    double shin = 0.0;

    [[nodiscard]] double reach() const noexcept { return kLegReach * (thigh + shin); }
    /// From hip joint to ankle at this bend of the knee (radians, 0: straight).
    [[nodiscard]] double at_bend(double bend) const noexcept;
};
[[nodiscard]] LegLengths leg_lengths(const Skeleton& skeleton) noexcept;

/// Pelvis, spine, neck and head into the pose; `hips` is the place of the hips.
void set_trunk(const Skeleton& skeleton,
               const BodyFrame& frame,
               const glm::dvec3& hips,
               Pose& pose) noexcept;

/// Thigh, shin, foot and toes of one side from the pelvis in the pose to a foot's plan, whose heel
/// is lifted by `extra_pitch`. Both knees point where foot (0.7) and pelvis (0.3) do. A swinging
/// foot that is out of reach is pulled nearer.
void set_leg(const Skeleton& skeleton,
             Side side,
             const PlannedFoot& foot,
             double extra_pitch,
             Pose& pose) noexcept;

/// Clavicle, arm, hand and fingers of one side on the trunk in the pose.
void set_arm(const Skeleton& skeleton, Side side, const BodyFrame& frame, Pose& pose) noexcept;

/// Where the thigh's joint is.
[[nodiscard]] glm::dvec3 hip_joint(const Skeleton& skeleton,
                                   Side side,
                                   const glm::dquat& pelvis,
                                   const glm::dvec3& hips) noexcept;

/// Centre of mass of a body (shares of segments: Winter 2009, table 4.1).
[[nodiscard]] glm::dvec3 centre_of_mass(const Skeleton& skeleton, const Pose& pose) noexcept;

}  // namespace raks::motion
