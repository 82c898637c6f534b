#pragma once

#include <array>
#include <vector>

#include "motion/choreography/repeat_plan.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// Foot plan: places and angles of the feet by frame, from the steps alone; sections 3 and 4 of the
/// evaluation in docs/reference/choreography.md.
namespace raks::motion {

/// One foot at one frame; metres and radians in the world.
struct PlannedFoot {
    glm::dvec2 ball{};         ///< x and z on the floor
    double height = 0.0;       ///< of the ball over the floor; 0 in contact (a raised heel aside)
    double yaw = 0.0;          ///< of the toes, 0 to the front
    double pitch = 0.0;        ///< > 0: heel up, about the ball; < 0: toes up, about the heel
    double heel = 0.0;         ///< part of `pitch` that the heel's control asks for
    bool is_swinging = false;  ///< between start and end of a step, slides too
    bool is_lifted = false;    ///< swings without sliding
};

/// Both feet and the weight, by frame.
struct FootPlan {
    std::array<std::vector<PlannedFoot>, 2> feet;  ///< by Side
    std::vector<double> weight;                    ///< share on the left foot, [0, 1]
    std::vector<double> facing;                    ///< smoothed mean yaw of both feet, radians
    std::vector<glm::dvec2> support;  ///< point on the floor over which the body belongs, metres
};

/// Plans the feet of all frames. Threads: any. Real-time: no.
[[nodiscard]] FootPlan plan_feet(const RepeatPlan& plan);

/// Rotation of a foot bone with this yaw and pitch.
[[nodiscard]] glm::dquat foot_rotation(double yaw, double pitch) noexcept;

/// Place of the ankle joint; metres, world. `extra_pitch` lifts the heel further; radians.
[[nodiscard]] glm::dvec3 ankle_of(const Skeleton& skeleton,
                                  Side side,
                                  const PlannedFoot& foot,
                                  double extra_pitch = 0.0) noexcept;

}  // namespace raks::motion
