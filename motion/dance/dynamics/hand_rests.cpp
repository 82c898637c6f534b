#include "motion/dance/dynamics/hand_rests.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

std::optional<HandPlace> another_place(std::span<const HandPlace> places,
                                       std::optional<HandPlace> last,
                                       double at) noexcept RAKS_NONBLOCKING {
    const auto is_other = [&](HandPlace place) { return place != last; };
    const auto others = std::count_if(places.begin(), places.end(), is_other);
    auto left = static_cast<std::ptrdiff_t>(at * static_cast<double>(others));
    for (const HandPlace place : places) {
        if (is_other(place) && left-- == 0) {
            return place;
        }
    }
    return std::nullopt;
}

const std::array<HandRests::Rest, kHandPlaceNames.size()> HandRests::kRests = {{
    {{0.17F, -0.91F, 0.16F}, {0.4F, 0.0F, -1.0F}},                // thigh
    {{0.06F, -0.66F, 0.04F}, {1.0F, 0.1F, -0.25F}},               // hip
    {{-0.18F, -0.52F, 0.44F}, {0.8F, -0.5F, -0.2F}},              // waist
    {{-0.14F, -0.20F, 0.56F}, {0.8F, -0.6F, 0.0F}},               // chest
    {{0.88F, 0.02F, 0.28F}, {0.1F, -1.0F, -0.3F}},                // wide
    {{0.42F, 0.82F, 0.22F}, {0.8F, -0.3F, 0.2F}},                 // high
    {{0.50F, -0.78F, 0.20F}, {0.5F, -0.2F, -1.0F}},               // low
    {{0.34F, -0.30F, 0.76F}, {0.5F, -1.0F, 0.0F}},                // offered
    {{0.22F, -0.80F, 0.46F}, {0.4F, -0.2F, -1.0F}},               // swing
    {{0.46F, -0.06F, 0.50F}, {0.4F, -1.0F, -0.2F}, 0.5F, -0.2F},  // snap
    {{-0.23F, -0.18F, 0.60F}, {0.6F, -1.0F, -0.1F}},              // clap
    {{0.38F, -0.86F, 0.12F}, {0.5F, 0.0F, -1.0F}, 0.0F, -0.3F},   // skirt
    {{0.07F, 0.42F, -0.06F}, {1.0F, 0.35F, -0.1F}},               // head
    {{0.60F, 0.10F, 0.52F}, {0.5F, -1.0F, -0.3F}, 0.5F},          // frame
}};

const std::array<HandRests::Sway, kHandPlaceNames.size()> HandRests::kSways = {{
    {.by = {0.03F, 0.0F, -0.16F}},                            // thigh
    {},                                                       // hip
    {},                                                       // waist
    {},                                                       // chest
    {},                                                       // wide
    {},                                                       // high
    {},                                                       // low
    {},                                                       // offered
    {.by = {0.10F, -0.10F, -0.62F}, .alternates = true},      // swing
    {.by = {0.06F, 0.13F, -0.06F}, .sharpness = 0.8F},        // snap
    {.by = {0.27F, 0.02F, -0.03F}, .sharpness = 0.9F},        // clap
    {.by = {0.03F, 0.10F, 0.20F}, .every = 3.0, .hit = 0.0},  // skirt
    {.by = {0.03F, 0.05F, 0.0F}, .every = 4.0},               // head
    {.by = {0.0F, 0.03F, 0.02F}, .every = 3.0},               // frame
}};

float HandRests::Sway::at(double beat, Side side) const noexcept {
    constexpr double kRound = 0.15;  // of a strike: hands do not turn back at once
    const double late = alternates && side == Side::right ? 0.5 : 0.0;
    const double sine = std::sin(M_PI * ((beat - hit) / every - late));
    const double strikes = (std::hypot(sine, kRound) - kRound) / (std::hypot(1.0, kRound) - kRound);
    return static_cast<float>(std::lerp(sine * sine, strikes, static_cast<double>(sharpness)));
}

HandRests::Rest HandRests::rest_at(HandPlace place, double beat, Side side) noexcept {
    // The right arm of the frame lies about the partner's back.
    constexpr Rest kRightOfFrame{{0.10F, -0.16F, 0.64F}, {1.0F, -0.35F, 0.0F}, -0.7F};
    const bool is_right_of_frame = place == HandPlace::frame && side == Side::right;
    Rest rest = is_right_of_frame ? kRightOfFrame : kRests[static_cast<std::size_t>(place)];
    const Sway& sway = kSways[static_cast<std::size_t>(place)];
    rest.wrist += sway.at(beat, side) * sway.by;
    return rest;
}

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
    float shoulders = 0.32F;        // from one to the other, metres

    [[nodiscard]] ArmPlace at(const Rest& rest) const noexcept {
        constexpr float kUsualHalf = 0.307F;  // of those of the mannequin, in lengths of its arm
        const float length = upper + lower;
        glm::vec3 place = rest.wrist;
        // What lies before the body is as far across as the shoulders are wide, whatever the arms.
        if (place.x < 0.0F) {
            place.x *= 0.5F * shoulders / (kUsualHalf * length);
        }
        const glm::vec3 wrist = facing * (on_side_of(place, side) * length);
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

/// How a hand is held at its place, and how much of it counts.
struct HeldHand {
    float turn;
    float bend;
    float weight;
};

/// Turns an arm to a place. What it is twisted by goes over from that of the dance to that of an
/// arm whose elbow bends about its hinge.
void turn_arm(const Skeleton& skeleton,
              const WorldPose& world,
              Side side,
              const ArmPlace& place,
              const HeldHand& hand,
              Pose& pose) noexcept {
    const float weight = hand.weight;
    const float sign = side == Side::left ? 1.0F : -1.0F;
    // The palm's turn is shared by forearm and wrist, as radius and ulna turn.
    const float quarter = 0.25F * hand.turn;
    const glm::quat half_turn{std::cos(quarter), -std::sin(quarter), 0.0F, 0.0F};
    const float half_bend = -0.5F * sign * hand.bend;
    const glm::quat bent{std::cos(half_bend), 0.0F, 0.0F, std::sin(half_bend)};
    const Limb arm = arm_of(world, side);
    const glm::vec3& to_elbow = skeleton.offsets[index_of(arm.lower)];
    const glm::vec3& to_wrist = skeleton.offsets[index_of(arm.end)];
    const glm::quat& upper = world.rotation(arm.upper);
    const glm::quat& lower = world.rotation(arm.lower);
    ArmTurns rest = hinged(place, side);
    rest.lower = rest.lower * half_turn;
    const glm::quat upper_now =
        untwisted(rotation_between(upper * to_elbow, place.elbow) * upper, rest.upper, weight);
    const glm::quat lower_now = untwisted(
        rotation_between(lower * to_wrist, place.wrist - place.elbow) * lower, rest.lower, weight);
    pose.rotation(arm.upper) = glm::normalize(glm::conjugate(arm.parent) * upper_now);
    pose.rotation(arm.lower) = glm::normalize(glm::conjugate(upper_now) * lower_now);
    pose.rotation(arm.end) = glm::slerp(pose.rotation(arm.end), half_turn * bent, weight);
}

}  // namespace

float HandRests::Way::share(StreamTime time) const noexcept {
    return smootherstep(static_cast<float>(to_seconds(time - since)) / seconds);
}

float HandRests::Hand::weight(StreamTime time) const noexcept {
    return from + (to - from) * way.share(time);
}

// Straight, but ahead of the body.
HandRests::Rest HandRests::Hand::rest(StreamTime time, double beat, Side side) const noexcept {
    constexpr float kAhead = 1.2F;
    const Rest there = rest_at(place, beat, side);
    const float share = change.share(time);
    if (share >= 1.0F) {
        return there;
    }
    const Rest here = place_before ? rest_at(*place_before, beat, side) : before;
    Rest rest{glm::mix(here.wrist, there.wrist, share),
              glm::mix(here.elbow, there.elbow, share),
              std::lerp(here.turn, there.turn, share),
              std::lerp(here.bend, there.bend, share)};
    rest.wrist.z += kAhead * share * (1.0F - share) * glm::distance(here.wrist, there.wrist);
    return rest;
}

void HandRests::go_to(Side side,
                      HandPlace place,
                      StreamTime now,
                      double beat,
                      double seconds) noexcept RAKS_NONBLOCKING {
    Hand& hand = hands_[static_cast<std::size_t>(side)];
    if (hand.to > 0.0F && hand.place == place) {
        return;
    }
    const Way way{now, static_cast<float>(seconds)};
    const float weight = hand.weight(now);
    if (weight > 0.0F && hand.change.share(now) < 1.0F) {
        hand.before = hand.rest(now, beat, side);
        hand.place_before.reset();
    } else {
        hand.place_before = weight > 0.0F ? hand.place : place;
    }
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
                      double beat,
                      Pose& pose) const noexcept RAKS_NONBLOCKING {
    const bool is_any = std::any_of(
        hands_.begin(), hands_.end(), [&](const Hand& hand) { return hand.weight(time) > 0.0F; });
    if (!is_any) {
        return;
    }
    const WorldPose world = world_body(skeleton, pose);
    const glm::quat facing = facing_of(world);
    const float shoulders =
        glm::distance(world.position(Bone::left_upper_arm), world.position(Bone::right_upper_arm));
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
                      facing,
                      shoulders};
        const Rest own = hand.rest(time, beat, side);
        const ArmPlace rest = arm.at(own);
        const ArmPlace danced = {world.position(limb.lower) - limb.root,
                                 world.position(limb.end) - limb.root};
        const HeldHand held{own.turn, own.bend, weight};
        turn_arm(skeleton, world, side, arm.between(danced, rest, weight), held, pose);
    }
}

}  // namespace raks::motion
