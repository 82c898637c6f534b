#include "motion/dance/standing.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/gtc/quaternion.hpp>

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

Pose idle_pose(const Skeleton& skeleton, StreamTime time) noexcept RAKS_NONBLOCKING {
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

namespace {

// Farther than this a foot cannot go in one step without crossing the other or lunging; then it
// takes two.
constexpr double kNearMetres = 0.35;
constexpr double kNearRadians = 0.8;
constexpr double kSecondsAStep = 0.33;
constexpr float kLift = 0.06F;        // metres at the middle of a step
constexpr double kSpeedDecay = 18.0;  // 1/s; decay of the speed that a foot had

double turn_between(const FloorMove& from, const FloorMove& to) noexcept {
    return std::remainder(to.heading - from.heading, 2.0 * M_PI);
}

// Steps of both feet together.
std::size_t steps_between(const FloorMove& from, const FloorMove& to) noexcept {
    const bool is_near = std::abs(turn_between(from, to)) < kNearRadians &&
                         glm::length(to.offset - from.offset) < kNearMetres;
    return is_near ? 2 : 4;
}

}  // namespace

void Standing::stand(const FloorMove& place) noexcept RAKS_NONBLOCKING {
    from_ = to_ = place;
    seconds_ = 0.0;
    step_count_ = 0;
}

Nanos Standing::duration(const FloorMove& from, const FloorMove& to) noexcept RAKS_NONBLOCKING {
    return nanos_from_seconds(kSecondsAStep * static_cast<double>(steps_between(from, to)));
}

FloorMove Standing::place(double share) const noexcept {
    const double eased = static_cast<double>(smootherstep(static_cast<float>(share)));
    return {from_.heading + eased * turn_between(from_, to_),
            from_.offset + eased * (to_.offset - from_.offset)};
}

void Standing::settle(const Skeleton& skeleton,
                      const Pose& shown,
                      const Pose& shown_before,
                      const FloorMove& from,
                      const FloorMove& to,
                      StreamTime now) noexcept RAKS_NONBLOCKING {
    from_ = from;
    to_ = to;
    since_ = now;
    step_count_ = steps_between(from, to);
    seconds_ = to_seconds(duration(from, to));
    const WorldPose world = world_body(skeleton, shown);
    const WorldPose before = world_body(skeleton, shown_before);
    for (const Side side : kSides) {
        const Bone bone = on_side(Bone::left_foot, side);
        feet_[static_cast<std::size_t>(side)] = {
            {world.position(bone), world.rotation(bone)},
            (world.position(bone) - before.position(bone)) * static_cast<float>(kHopsPerSecond)};
    }
    // The higher foot steps first: it may be in the air.
    Side side = feet_[0].from.ankle.y > feet_[1].from.ankle.y ? Side::left : Side::right;
    const std::size_t count = step_count_;
    for (std::size_t i = 0; i < count; ++i) {
        // Of four steps the first lands halfway, the second at three quarters, the last two at the
        // end.
        const double share =
            count == 2 ? 1.0
                       : std::min(1.0, static_cast<double>(i + 2) / static_cast<double>(count));
        const double heading = from_.heading + share * turn_between(from_, to_);
        const FloorMove there{heading, from_.offset + share * (to_.offset - from_.offset)};
        const WorldPose standing = world_body(skeleton, there(idle_pose(skeleton, now)));
        const Bone bone = on_side(Bone::left_foot, side);
        steps_[i] = {side, {standing.position(bone), standing.rotation(bone)}};
        side = side == Side::left ? Side::right : Side::left;
    }
}

bool Standing::is_settled(StreamTime time) const noexcept RAKS_NONBLOCKING {
    return to_seconds(time - since_) >= seconds_;
}

Pose Standing::at(const Skeleton& skeleton, StreamTime time) const noexcept RAKS_NONBLOCKING {
    const double share = seconds_ > 0.0 ? to_seconds(time - since_) / seconds_ : 1.0;
    return place(share)(idle_pose(skeleton, time));
}

// Applies the steps of one foot that have begun, one after the other; their lift is a parabola in
// the share.
FootTarget Standing::foot(Side side, double elapsed, bool& stands) const noexcept {
    const Foot& own = feet_[static_cast<std::size_t>(side)];
    FootTarget at = own.from;
    stands = true;
    const double seconds = seconds_ / static_cast<double>(step_count_);
    for (std::size_t i = 0; i < step_count_; ++i) {
        const double u = elapsed / seconds - static_cast<double>(i);
        if (steps_[i].side != side || u <= 0.0) {
            continue;
        }
        const float share = smootherstep(static_cast<float>(u));
        at.ankle = glm::mix(at.ankle, steps_[i].to.ankle, share);
        at.rotation = glm::slerp(at.rotation, steps_[i].to.rotation, share);
        if (u < 1.0) {
            at.ankle.y += kLift * 4.0F * share * (1.0F - share);
            stands = false;
        }
    }
    // What speed the foot had fades out: t exp(-a t) starts with slope 1 and returns to zero.
    at.ankle += own.speed * static_cast<float>(elapsed * std::exp(-kSpeedDecay * elapsed));
    return at;
}

void Standing::plant(const Skeleton& skeleton,
                     StreamTime time,
                     Pose& pose) const noexcept RAKS_NONBLOCKING {
    if (step_count_ == 0) {
        return;
    }
    const double elapsed = std::max(0.0, to_seconds(time - since_));
    for (const Side side : kSides) {
        bool stands = true;
        FootTarget target = foot(side, elapsed, stands);
        const float standing = -lowest_of_sole(
            skeleton, side, target.rotation, pose.rotation(on_side(Bone::left_toes, side)));
        target.ankle.y = std::max(target.ankle.y, standing);
        solve_leg(skeleton, side, target, pose);
        pose.foot_contact[static_cast<std::size_t>(side)] = stands;
    }
}

}  // namespace raks::motion
