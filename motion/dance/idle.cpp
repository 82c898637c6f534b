#include "motion/dance/idle.hpp"

#include <cmath>

#include "motion/dance/body/leg_ik.hpp"
#include "motion/dance/body/relaxed_hands.hpp"

namespace raks::motion {
namespace {

constexpr float kStance = 0.10F;    // metres from the middle to each ankle
constexpr float kToesOut = 0.16F;   // radians
constexpr float kBent = 0.985F;     // hips' height, of standing straight: soft knees
constexpr float kSway = 0.022F;     // metres of the hips to each side
constexpr float kArmsDown = 1.28F;  // radians from the T-pose
constexpr float kElbows = 0.35F;    // radians of bend
// Periods in seconds whose ratio is no simple fraction: the pose does not repeat for minutes.
constexpr double kSwayPeriod = 5.3;
constexpr double kTurnPeriod = 8.7;
constexpr double kBreathPeriod = 3.7;

float wave(StreamTime time, double period) {
    return static_cast<float>(std::sin(2.0 * M_PI * to_seconds(time) / period));
}

glm::quat about(float radians, glm::vec3 axis) { return glm::angleAxis(radians, axis); }

constexpr glm::vec3 kX{1, 0, 0};
constexpr glm::vec3 kY{0, 1, 0};
constexpr glm::vec3 kZ{0, 0, 1};

}  // namespace

Pose idle_pose(const Skeleton& skeleton, StreamTime time) noexcept {
    const float sway = wave(time, kSwayPeriod);
    const float turn = wave(time, kTurnPeriod);
    const float breath = wave(time, kBreathPeriod);
    Pose pose;
    pose.hips_position = {
        kSway * sway, kBent * skeleton.hips_height() - 0.004F * sway * sway, 0.006F * turn};
    // Spine and chest lean against the hips' roll.
    pose.rotation(Bone::hips) = about(0.05F * turn, kY) * about(0.035F * sway, kZ);
    pose.rotation(Bone::spine) = about(-0.03F * sway, kZ) * about(0.02F, kX);
    pose.rotation(Bone::chest) = about(-0.03F * sway, kZ) * about(-0.012F * breath, kX);
    pose.rotation(Bone::upper_chest) = about(-0.012F * breath, kX);
    pose.rotation(Bone::neck) = about(0.02F * sway, kZ) * about(0.04F, kX);
    pose.rotation(Bone::head) = about(-0.07F * turn, kY) * about(0.03F * breath, kX);
    // Arms: mirrored by the sign of the rotations about y and z.
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_shoulder, side)) = about(sign * 0.015F * breath, kZ);
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            about(-sign * (kArmsDown - 0.02F * breath), kZ) * about(0.12F, kX);
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            about(-sign * (kElbows + 0.03F * sway), kY);
    }
    relax_hands(pose);
    const float ankle_height = -skeleton.ball.y;
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        FootTarget target;
        target.ankle = {sign * kStance, ankle_height, -0.02F};
        target.rotation = about(sign * kToesOut, kY);
        solve_leg(skeleton, side, target, pose);
        pose.foot_contact[static_cast<std::size_t>(side)] = true;
    }
    return pose;
}

}  // namespace raks::motion
