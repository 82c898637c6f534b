#include "motion/dance/standing.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/body/easing.hpp"
#include "motion/dance/idle.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
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

void Standing::stand(const FloorMove& place) noexcept {
    from_ = to_ = place;
    seconds_ = 0.0;
    step_count_ = 0;
}

Nanos Standing::duration(const FloorMove& from, const FloorMove& to) noexcept {
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
                      StreamTime now) noexcept {
    from_ = from;
    to_ = to;
    since_ = now;
    step_count_ = steps_between(from, to);
    seconds_ = to_seconds(duration(from, to));
    const WorldPose world = world_pose(skeleton, shown);
    const WorldPose before = world_pose(skeleton, shown_before);
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
        const WorldPose standing = world_pose(skeleton, there(idle_pose(skeleton, now)));
        const Bone bone = on_side(Bone::left_foot, side);
        steps_[i] = {side, {standing.position(bone), standing.rotation(bone)}};
        side = side == Side::left ? Side::right : Side::left;
    }
}

bool Standing::is_settled(StreamTime time) const noexcept {
    return to_seconds(time - since_) >= seconds_;
}

Pose Standing::at(const Skeleton& skeleton, StreamTime time) const noexcept {
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

void Standing::plant(const Skeleton& skeleton, StreamTime time, Pose& pose) const noexcept {
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
