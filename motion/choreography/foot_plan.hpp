#pragma once

#include <array>
#include <vector>

#include "motion/choreography/repeat_plan.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// Where the feet are, from the steps alone: section 3 and 4 of the evaluation in
/// docs/reference/choreography.md.
namespace raks::motion {

/// One foot at one frame; metres and radians in the world.
struct PlannedFoot {
    glm::dvec2 ball{};    ///< x and z on the floor
    double height = 0.0;  ///< of the ball over the floor; 0 in contact (but for a raised heel's)
    double yaw = 0.0;     ///< of the toes, 0 to the front
    double pitch = 0.0;   ///< > 0: heel up, about the ball; < 0: toes up, about the heel
    double heel = 0.0;    ///< pitch that is danced on purpose, part of `pitch`
    bool is_swinging = false;  ///< also a slide
    bool is_lifted = false;    ///< swings and does not slide
};

/// By frame.
struct FootPlan {
    std::array<std::vector<PlannedFoot>, 2> feet;  ///< by Side
    std::vector<double> weight;                    ///< on the left foot, [0, 1]
    std::vector<double> facing;                    ///< smoothed mean of the feet's yaw, radians
    std::vector<glm::dvec2> support;  ///< where the body's weight belongs, metres on the floor
};

[[nodiscard]] FootPlan plan_feet(const RepeatPlan& plan);

/// Rotation of a foot bone with this yaw and pitch.
[[nodiscard]] glm::dquat foot_rotation(double yaw, double pitch) noexcept;

/// Where the ankle is; `extra_pitch` lifts the heel further.
[[nodiscard]] glm::dvec3 ankle_of(const Skeleton& skeleton,
                                  Side side,
                                  const PlannedFoot& foot,
                                  double extra_pitch = 0.0) noexcept;

}  // namespace raks::motion
