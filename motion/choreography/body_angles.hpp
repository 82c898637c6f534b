#pragma once

#include <array>
#include <vector>

#include "motion/choreography/foot_plan.hpp"
#include "motion/choreography/repeat_plan.hpp"

#include <glm/gtc/quaternion.hpp>

/// Orientation of pelvis, chest, head and arms in space, before height and balance: section 5 and
/// the directions of section 8 of the evaluation in docs/reference/choreography.md.
namespace raks::motion {

/// Orientation of a body part: yaw, then roll, then tilt; radians.
struct BodyAngles {
    double yaw = 0.0;   ///< to the left
    double roll = 0.0;  ///< left side up
    double tilt = 0.0;  ///< top forward

    /// Ry(yaw) Rz(roll) Rx(tilt).
    [[nodiscard]] glm::dquat rotation() const noexcept;
};

/// Angles of one arm at one frame; radians.
struct ArmAngles {
    double up = 0.0;           ///< of the line from shoulder to hand over the horizontal
    double front = 0.0;        ///< of that line from sideways to the front
    double bend = 0.0;         ///< of the elbow, >= 0
    double elbow = 0.0;        ///< turn of the elbow about that line; 0: down, out and back
    double shoulder_up = 0.0;  ///< lift of the collarbone
    double hand_bend = 0.0;    ///< of the wrist
    double hand_turn = 0.0;    ///< of the palm about the forearm
    double fist = 0.25;        ///< how far the hand is closed, [0, 1]
};

/// Orientations and shifts of one frame, before any heights. All are turned by `facing` first.
struct BodyFrame {
    double facing = 0.0;       ///< of the whole body; radians
    BodyAngles pelvis;         ///< orientation in the facing frame
    BodyAngles chest;          ///< orientation in the facing frame, not relative to the pelvis
    BodyAngles arm_frame;      ///< frame of the arms: the mean of the chest now and lag_arm ago
    BodyAngles head;           ///< orientation in the facing frame
    glm::dvec2 chest_slide{};  ///< of the chest over the hips: left, forward; metres
    glm::dvec3 hip_shift{};    ///< from the support: left, up, forward; metres
    double knee = 0.0;         ///< bend of the carrying knee; radians
    std::array<ArmAngles, 2> arms;  ///< by Side
};

/// The frames of a plan whose feet are known. Threads: any. Real-time: no.
[[nodiscard]] std::vector<BodyFrame> body_frames(const RepeatPlan& plan, const FootPlan& feet);

}  // namespace raks::motion
