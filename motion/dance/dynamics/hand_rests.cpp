#include "motion/dance/dynamics/hand_rests.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

const std::array<HandRests::Rest, kHandPlaceNames.size()> HandRests::kRests = {{
    {{0.16F, -0.92F, 0.10F}, {0.4F, 0.0F, -1.0F}},    // thigh
    {{0.06F, -0.66F, 0.04F}, {1.0F, 0.1F, -0.25F}},   // hip
    {{-0.18F, -0.52F, 0.44F}, {0.8F, -0.5F, -0.2F}},  // waist
    {{-0.14F, -0.20F, 0.56F}, {0.8F, -0.6F, 0.0F}},   // chest
    {{0.88F, 0.02F, 0.28F}, {0.1F, -1.0F, -0.3F}},    // wide
    {{0.42F, 0.82F, 0.22F}, {0.8F, -0.3F, 0.2F}},     // high
    {{0.50F, -0.78F, 0.20F}, {0.5F, -0.2F, -1.0F}},   // low
    {{0.34F, -0.30F, 0.76F}, {0.5F, -1.0F, 0.0F}},    // offered
}};

namespace {

/// Facing of the trunk on the floor: between that of hips and shoulders.
glm::quat facing_of(const WorldPose& world) noexcept {
    const glm::vec3 ahead{0.0F, 0.0F, 1.0F};
    const glm::vec3 both =
        world.rotation(Bone::hips) * ahead + world.rotation(Bone::upper_chest) * ahead;
    const float yaw = std::atan2(both.x, both.z);
    return turn_about_up(yaw);
}

glm::vec3 on_side_of(glm::vec3 left, Side side) noexcept {
    return {side == Side::left ? left.x : -left.x, left.y, left.z};
}

/// Where elbow and wrist are, from the shoulder's joint; metres, world.
struct ArmPlace {
    glm::vec3 elbow;
    glm::vec3 wrist;
};

glm::vec3 square_to(const glm::vec3& line, const glm::vec3& vector) noexcept {
    return vector - line * glm::dot(line, vector);
}

/// On which side of its line an arm has its elbow, as if it pointed along `line`; of length 1 or
/// less, 0 for a straight arm.
glm::vec3 elbow_side(const ArmPlace& arm, const glm::vec3& line) noexcept {
    constexpr float kBent = 0.05F;  // metres from the line, from which the side is sure
    const glm::vec3 own = glm::normalize(arm.wrist);
    const glm::vec3 side = square_to(own, arm.elbow);
    return rotation_between(own, line) * side / std::max(glm::length(side), kBent);
}

/// The arm whose wrist is as near to `wrist` as it reaches, its elbow on that side of the line.
ArmPlace arm_to(const glm::vec3& wrist, const glm::vec3& side, float upper, float lower) noexcept {
    constexpr float kLeast = 0.01F;  // metres more than the elbow bends to
    const float wanted = std::max(glm::length(wrist), kLeast);
    const glm::vec3 line = wrist / wanted;
    const float distance =
        std::clamp(wanted, std::abs(upper - lower) + kLeast, kLongestReach * (upper + lower));
    const float along = (upper * upper - lower * lower + distance * distance) / (2.0F * distance);
    const float aside = std::sqrt(std::max(0.0F, upper * upper - along * along));
    const glm::vec3 pole = square_to(line, side);
    return {line * along + pole * (aside / std::max(glm::length(pole), 1e-6F)), line * distance};
}

}  // namespace

/// An arm of a body.
struct HandRests::Arm {
    Side side = Side::left;
    float upper = 0.3F;  // lengths, metres
    float lower = 0.3F;
    glm::quat facing{kNoRotation};  // of the trunk

    [[nodiscard]] ArmPlace at(const Rest& rest) const noexcept {
        const glm::vec3 wrist = facing * (on_side_of(rest.wrist, side) * (upper + lower));
        return arm_to(wrist, facing * on_side_of(rest.elbow, side), upper, lower);
    }

    /// On the way between two places. A wrist that would come by the shoulder goes round it, ahead
    /// and outside; an elbow that would change sides at once goes below and outside.
    [[nodiscard]] ArmPlace between(const ArmPlace& from,
                                   const ArmPlace& to,
                                   float share) const noexcept {
        const float near_from = std::max(glm::length(from.wrist), 0.01F);
        const float near_to = std::max(glm::length(to.wrist), 0.01F);
        const glm::vec3 one = from.wrist / near_from;
        const glm::vec3 other = to.wrist / near_to;
        const float midway = 4.0F * share * (1.0F - share);
        const float apart = 1.0F - glm::dot(one, other);  // 0: the same direction; 2: the opposite
        const glm::vec3 ahead = facing * on_side_of({0.5F, 0.0F, 0.87F}, side);
        const glm::vec3 line =
            glm::normalize(glm::mix(one, other, share) + 0.5F * midway * apart * ahead);
        const glm::vec3 elbow = glm::mix(elbow_side(from, line), elbow_side(to, line), share);
        const glm::vec3 below = square_to(line, facing * on_side_of({0.7F, -0.7F, -0.2F}, side));
        const float unsure = midway * std::max(0.0F, 1.0F - glm::length(elbow));
        return arm_to(
            line * glm::mix(near_from, near_to, share), elbow + unsure * below, upper, lower);
    }
};

namespace {

/// `from` untwisted towards `to`, which points the bone the same way. Less where they are nearly
/// half a turn apart: either way round is as long there, and the arm would flip.
glm::quat untwisted(const glm::quat& from, const glm::quat& to, float weight) noexcept {
    constexpr float kSurely = 1.8F;  // radians
    constexpr float kFlips = 3.05F;
    const float apart = 2.0F * std::acos(std::min(1.0F, std::abs(glm::dot(from, to))));
    return glm::slerp(from, to, weight * (1.0F - smoothstep(kSurely, kFlips, apart)));
}

/// Rotations of upper arm and forearm, world.
struct ArmTurns {
    glm::quat upper{kNoRotation};
    glm::quat lower{kNoRotation};
};

/// An arm at a place whose elbow bends about its own hinge, as elbows do: the axis that is upright
/// in the T-pose.
ArmTurns hinged(const ArmPlace& place, Side side) noexcept {
    const float sign = side == Side::left ? 1.0F : -1.0F;
    const glm::vec3 along = glm::normalize(place.elbow);
    const glm::vec3 forearm = glm::normalize(place.wrist - place.elbow);
    const glm::vec3 across = glm::cross(along, forearm);
    const float bent = std::max(glm::length(across), 1e-4F);
    const glm::vec3 hinge = across * (-sign / bent);
    const glm::vec3 out = sign * along;  // the T-pose's x
    const glm::quat upper = glm::quat_cast(glm::mat3(out, hinge, glm::cross(out, hinge)));
    const float angle = std::atan2(bent, glm::dot(along, forearm));
    const glm::quat bend{std::cos(0.5F * angle), 0.0F, -sign * std::sin(0.5F * angle), 0.0F};
    return {upper, upper * bend};
}

/// Turns an arm to a place. What it is twisted by goes over from that of the dance to that of an
/// arm whose elbow bends about its hinge.
void turn_arm(const Skeleton& skeleton,
              const WorldPose& world,
              Side side,
              const ArmPlace& place,
              float weight,
              Pose& pose) noexcept {
    const Limb arm = arm_of(world, side);
    const glm::vec3& to_elbow = skeleton.offsets[index_of(arm.lower)];
    const glm::vec3& to_wrist = skeleton.offsets[index_of(arm.end)];
    const glm::quat& upper = world.rotation(arm.upper);
    const glm::quat& lower = world.rotation(arm.lower);
    const ArmTurns rest = hinged(place, side);
    const glm::quat upper_now =
        untwisted(rotation_between(upper * to_elbow, place.elbow) * upper, rest.upper, weight);
    const glm::quat lower_now = untwisted(
        rotation_between(lower * to_wrist, place.wrist - place.elbow) * lower, rest.lower, weight);
    pose.rotation(arm.upper) = glm::normalize(glm::conjugate(arm.parent) * upper_now);
    pose.rotation(arm.lower) = glm::normalize(glm::conjugate(upper_now) * lower_now);
    pose.rotation(arm.end) = glm::slerp(pose.rotation(arm.end), kNoRotation, weight);
}

}  // namespace

float HandRests::Way::share(StreamTime time) const noexcept {
    return smootherstep(static_cast<float>(to_seconds(time - since)) / seconds);
}

float HandRests::Hand::weight(StreamTime time) const noexcept {
    return from + (to - from) * way.share(time);
}

// Straight, but ahead of the body.
HandRests::Rest HandRests::Hand::rest(StreamTime time) const noexcept {
    constexpr float kAhead = 1.2F;
    const Rest& there = kRests[static_cast<std::size_t>(place)];
    const float share = change.share(time);
    Rest rest{glm::mix(before.wrist, there.wrist, share),
              glm::mix(before.elbow, there.elbow, share)};
    rest.wrist.z += kAhead * share * (1.0F - share) * glm::distance(before.wrist, there.wrist);
    return rest;
}

void HandRests::go_to(Side side,
                      HandPlace place,
                      StreamTime now,
                      double seconds) noexcept RAKS_NONBLOCKING {
    Hand& hand = hands_[static_cast<std::size_t>(side)];
    if (hand.to > 0.0F && hand.place == place) {
        return;
    }
    const Way way{now, static_cast<float>(seconds)};
    const float weight = hand.weight(now);
    hand.before = weight > 0.0F ? hand.rest(now) : kRests[static_cast<std::size_t>(place)];
    hand.place = place;
    hand.change = hand.way = way;
    hand.from = weight;
    hand.to = 1.0F;
}

void HandRests::let_go(Side side, StreamTime now, double seconds) noexcept RAKS_NONBLOCKING {
    Hand& hand = hands_[static_cast<std::size_t>(side)];
    if (hand.to == 0.0F) {
        return;
    }
    hand.from = hand.weight(now);
    hand.to = 0.0F;
    hand.way = {now, static_cast<float>(seconds)};
}

void HandRests::apply(const Skeleton& skeleton,
                      StreamTime time,
                      Pose& pose) const noexcept RAKS_NONBLOCKING {
    const bool is_any = std::any_of(
        hands_.begin(), hands_.end(), [&](const Hand& hand) { return hand.weight(time) > 0.0F; });
    if (!is_any) {
        return;
    }
    const WorldPose world = world_body(skeleton, pose);
    const glm::quat facing = facing_of(world);
    for (const Side side : kSides) {
        const Hand& hand = hands_[static_cast<std::size_t>(side)];
        const float weight = hand.weight(time);
        if (weight <= 0.0F) {
            continue;
        }
        const Limb limb = arm_of(world, side);
        const Arm arm{side,
                      glm::length(skeleton.offsets[index_of(limb.lower)]),
                      glm::length(skeleton.offsets[index_of(limb.end)]),
                      facing};
        const ArmPlace rest = arm.at(hand.rest(time));
        const ArmPlace danced = {world.position(limb.lower) - limb.root,
                                 world.position(limb.end) - limb.root};
        turn_arm(skeleton, world, side, arm.between(danced, rest, weight), weight, pose);
    }
}

}  // namespace raks::motion
