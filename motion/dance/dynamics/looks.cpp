#include "motion/dance/dynamics/looks.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/dance/body/floor_move.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kLookSeconds = 2.2;  // one look
constexpr float kHop_s = static_cast<float>(to_seconds(kHop));
constexpr float kHeadTime = 0.13F;     // seconds; of each stage of the filter
constexpr float kSightTime = 0.40F;    // seconds; over which hands and ways are judged
constexpr float kQuickest = 5.0F;      // m/s; faster is a leap, not a movement
constexpr float kSurelySeen = 1.1F;    // radians aside of the trunk's heading that a head turns to
constexpr float kNeverSeen = 2.2F;     // beyond it nothing is looked at
constexpr float kFarthestTurn = 0.9F;  // radians that neck and head turn at most
constexpr float kFarthestTilt = 0.35F;
// A head that looks farther down than this, for so long, is lifted; radians, seconds.
constexpr float kHangs = 0.52F;
constexpr float kMayHang = 0.12F;
constexpr float kLiftedTo = 0.40F;
constexpr float kFarthestLift = 0.60F;
constexpr float kLiftTime = 0.08F;    // of each stage of its filter
constexpr float kWaitsAside = 0.75F;  // radians to the sides, of who looks around

// A hand is worth a look from this speed on, where it is this far over the shoulders; metres.
constexpr float kHandWorks = 0.5F;
constexpr float kHandLow = -0.12F;
constexpr float kHandHigh = 0.08F;
constexpr float kWayShows = 0.15F;  // m/s from which a way is looked along
constexpr float kWayIsSure = 0.40F;

// Shares of looks while dancing: at nothing in particular; of the others, at a hand that works,
// along the way. What is left goes to the audience.
constexpr double kAtNothing = 0.30;
constexpr double kAtHand = 0.45;
constexpr double kAlongWay = 0.75;
constexpr float kHandShare = 0.55F;  // of the way that the head goes: the eyes do the rest
constexpr float kWayShare = 0.60F;

constexpr std::uint64_t kAimStream = 11;  // streams of random numbers
constexpr std::uint64_t kAttentionStream = 12;

float heading_of_bone(const WorldPose& world, Bone bone) noexcept {
    const glm::vec3 ahead = world.rotation(bone) * glm::vec3(0.0F, 0.0F, 1.0F);
    return std::atan2(ahead.x, ahead.z);
}

float wrapped(float radians) noexcept {
    return std::remainder(radians, 2.0F * static_cast<float>(M_PI));
}

glm::vec3 direction(float heading) noexcept { return {std::sin(heading), 0.0F, std::cos(heading)}; }

/// Radians over the horizon.
float rise(const glm::vec3& towards) noexcept {
    return std::atan2(towards.y, std::hypot(towards.x, towards.z));
}

/// Raises the head about the axis through the ears, half by the neck; turns it about the upright
/// axis.
void turn_head(const WorldPose& world, float turn, float lift, Pose& pose) noexcept {
    const float faces = heading_of_bone(world, Bone::head) + turn;
    const glm::vec3 ears = {std::cos(faces), 0.0F, -std::sin(faces)};
    const glm::quat nod = glm::angleAxis(-0.5F * lift, ears) * turn_about_up(0.5F * turn);
    for (const Bone bone : {Bone::neck, Bone::head}) {
        const glm::quat parent =
            bone == Bone::neck ? world.rotation(Bone::upper_chest) : world.rotation(Bone::neck);
        const glm::quat own = glm::conjugate(parent) * nod * parent;
        pose.rotation(bone) = glm::normalize(own * pose.rotation(bone));
    }
}

template <typename Value>
void follow(const Value& target, float seconds, Value& value) noexcept {
    value += (kHop_s / seconds) * (target - value);
}

}  // namespace

/// Speeds of hands and hips, and how high the hands are, as averages over the last half second.
void Looks::see(const Skeleton& skeleton, const Pose& shown) noexcept {
    const WorldPose world = world_body(skeleton, shown);
    see_feet(world);
    const glm::vec3 head = world.position(Bone::head);
    const auto speed = [](const glm::vec3& way) {
        const float length = glm::length(way);
        return length > kQuickest * kHop_s ? glm::vec3(0.0F) : way / kHop_s;
    };
    const glm::vec3 way = shown.hips_position - sights_.hips;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const glm::vec3 hand = world.position(on_side(Bone::left_hand, side)) - head;
        const float raised = world.position(on_side(Bone::left_hand, side)).y -
                             world.position(on_side(Bone::left_upper_arm, side)).y;
        if (sights_.is_known) {
            follow(glm::length(speed(hand - sights_.hands[s])), kSightTime, sights_.quickness[s]);
            follow(raised, kSightTime, sights_.raised[s]);
        }
        sights_.hands[s] = hand;
    }
    if (sights_.is_known) {
        follow(speed({way.x, 0.0F, way.z}), kSightTime, sights_.travel);
    }
    sights_.hips = shown.hips_position;
    sights_.is_known = true;
}

/// Notes for how long the head would hang, and how much it is to be lifted then.
void Looks::see_feet(const WorldPose& world) noexcept {
    const glm::vec3 ahead = world.rotation(Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F);
    const float own = rise(ahead) - lifts_.back();
    seconds_down_ = own < -kHangs ? seconds_down_ + kHop_s : 0.0F;
    wanted_lift_ =
        seconds_down_ > kMayHang ? std::clamp(-kLiftedTo - own, 0.0F, kFarthestLift) : 0.0F;
}

Looks::Aim Looks::aim_at(std::uint64_t cell, std::uint64_t seed, LookFor what) const noexcept {
    const double where = CounterRandom(seed, kAimStream).uniform(cell);
    const double attention = CounterRandom(seed, kAttentionStream).uniform(cell);
    const Aim audience{direction(0.0F), 0.0F, 0.0F};
    if (what == LookFor::pose) {
        return {audience.towards, 0.85F, 0.0F};
    }
    if (what == LookFor::wait) {
        // Every second look is to the front.
        const float aside =
            attention < 0.5 ? 0.0F : kWaitsAside * static_cast<float>(2.0 * where - 1.0);
        return {direction(aside), 0.8F, 0.0F};
    }
    if (attention < kAtNothing) {
        return audience;
    }
    const std::size_t hand = sights_.quickness[0] >= sights_.quickness[1] ? 0 : 1;
    const float works = smoothstep(kHandLow, kHandHigh, sights_.raised[hand]) *
                        smoothstep(kHandWorks, 2.0F * kHandWorks, sights_.quickness[hand]);
    if (where < kAtHand && works > 0.0F) {
        return {sights_.hands[hand], kHandShare * works, kHandShare * works};
    }
    const float goes = smoothstep(kWayShows, kWayIsSure, glm::length(sights_.travel));
    if (where < kAlongWay && goes > 0.0F) {
        return {sights_.travel, kWayShare * goes, 0.0F};
    }
    return {audience.towards, static_cast<float>(0.75 * attention), 0.0F};
}

void Looks::advance(const Skeleton& skeleton,
                    StreamTime time,
                    std::uint64_t seed,
                    LookFor what,
                    const Pose& shown) noexcept RAKS_NONBLOCKING {
    see(skeleton, shown);
    const double seconds = std::max(0.0, to_seconds(time.time_since_epoch()));
    target_ = aim_at(static_cast<std::uint64_t>(seconds / kLookSeconds), seed, what);
    const float length = glm::length(target_.towards);
    target_.towards = length > 1e-4F ? target_.towards / length : direction(0.0F);
    go_on();
}

void Looks::go_on() noexcept RAKS_NONBLOCKING {
    const Aim* input = &target_;
    for (Aim& stage : stages_) {
        follow(input->towards, kHeadTime, stage.towards);
        follow(input->turn, kHeadTime, stage.turn);
        follow(input->tilt, kHeadTime, stage.tilt);
        input = &stage;
    }
    follow(wanted_lift_, kLiftTime, lifts_[0]);
    follow(lifts_[0], kLiftTime, lifts_[1]);
}

void Looks::lift_head(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING {
    if (lifts_.back() > 0.0F) {
        turn_head(world_body(skeleton, pose), 0.0F, lifts_.back(), pose);
    }
}

void Looks::apply(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const Aim& aim = stages_.back();
    const WorldPose world = world_body(skeleton, pose);
    const float heading = std::atan2(aim.towards.x, aim.towards.z);
    const float aside = wrapped(heading - heading_of_bone(world, Bone::upper_chest));
    const float seen = 1.0F - smoothstep(kSurelySeen, kNeverSeen, std::abs(aside));
    const float missing = wrapped(heading - heading_of_bone(world, Bone::head));
    const float turn = aim.turn * seen * std::clamp(missing, -kFarthestTurn, kFarthestTurn);
    const glm::vec3 ahead = world.rotation(Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F);
    const float lift = aim.tilt * seen *
                       std::clamp(rise(aim.towards) - rise(ahead), -kFarthestTilt, kFarthestTilt);
    turn_head(world, turn, lift + lifts_.back(), pose);
}

}  // namespace raks::motion
