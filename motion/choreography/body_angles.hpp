#pragma once

#include <array>
#include <vector>

#include "motion/choreography/foot_plan.hpp"
#include "motion/choreography/repeat_plan.hpp"

#include <glm/gtc/quaternion.hpp>

/// Which way pelvis, chest, head and arms turn in space, before any height or balance: section 5
/// and the directions of section 8 of the evaluation in docs/reference/choreography.md.
namespace raks::motion {

/// A turned frame as dancers say it: yaw to the left, then left side up, then top forward; radians.
struct BodyAngles {
    double yaw = 0.0;
    double roll = 0.0;
    double tilt = 0.0;

    [[nodiscard]] glm::dquat rotation() const noexcept;
};

/// Of one arm at a frame; radians.
struct ArmAngles {
    double up = 0.0;
    double front = 0.0;
    double bend = 0.0;
    double elbow = 0.0;
    double shoulder_up = 0.0;
    double hand_bend = 0.0;
    double hand_turn = 0.0;
    double fist = 0.25;  ///< share
};

/// Everything but places, at one frame. All frames are turned by `facing` first.
struct BodyFrame {
    double facing = 0.0;
    BodyAngles pelvis;
    BodyAngles chest;
    BodyAngles arm_frame;  ///< what the arms are held against: half the chest, half a late one
    BodyAngles head;
    glm::dvec2 chest_slide{};  ///< left, forward; metres
    glm::dvec3 hip_shift{};    ///< left, up, forward; metres
    double knee = 0.0;
    std::array<ArmAngles, 2> arms;  ///< by Side
};

[[nodiscard]] std::vector<BodyFrame> body_frames(const RepeatPlan& plan, const FootPlan& feet);

}  // namespace raks::motion
