#include "motion/dance/partner_clearance.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/body/elbow.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Metres that an arm keeps off the skin: clothes and hair are thick.
constexpr float kSpare = 0.03F;
constexpr float kSoft = 0.05F;  // metres before that at which it is pushed first
// A hand that lies on the partner may be so near, metres, and no more of it is in the way.
constexpr float kLying = -0.03F;
constexpr float kNeck = 0.8F;   // radius of neck and upper chest, of that of a flank
constexpr float kKnees = 0.0F;  // metres that legs keep apart
constexpr float kLeastLever = 0.4F;
constexpr float kMostKnee = 0.10F;  // metres that a knee goes aside for one part, soft limit
constexpr float kUpperArm = 0.06F;  // radius; metres
// Weight, metres, of the direction towards the arm's own body: where an arm goes that is deep
// inside, where the nearest skin says little.
constexpr float kOutward = 0.06F;
constexpr int kRounds = 3;  // a push out of one part may lead into another
constexpr float kLeast = 1e-4F;
constexpr float kFingers =
    1.4F;  // length of a hand, from the wrist to the middle finger's second joint
constexpr float kSmallHand = 0.05F;  // metres

/// `depth`, rounded where it begins; once differentiable, 0 below -kSoft.
float soft_depth_of(float depth) noexcept {
    if (depth <= -kSoft) {
        return 0.0F;
    }
    return depth >= kSoft ? depth : (depth + kSoft) * (depth + kSoft) / (4.0F * kSoft);
}

glm::vec3 unit(const glm::vec3& vector, const glm::vec3& otherwise) noexcept {
    const float length = glm::length(vector);
    return length > kLeast ? vector / length : otherwise;
}

/// Forearm and hand as one bone each.
struct ArmSkin {
    std::array<Capsule, 2> parts;

    ArmSkin(const Girth& girth, const WorldPose& world, Side side) noexcept {
        const auto joint = [&](Bone left) { return world.position(on_side(left, side)); };
        const glm::vec3 wrist = joint(Bone::left_hand);
        const glm::vec3 elbow = joint(Bone::left_lower_arm);
        // A body may have no fingers.
        glm::vec3 hand = kFingers * (joint(Bone::left_middle_intermediate) - wrist);
        if (glm::length(hand) < kSmallHand) {
            hand = kSmallHand * unit(wrist - elbow, glm::vec3(0.0F, 1.0F, 0.0F));
        }
        parts = {{{elbow, wrist, girth.forearm}, {wrist, wrist + hand, girth.hand}}};
    }
};

}  // namespace

/// What a part asks of an arm: of its hand, and of its elbow.
struct PartnerBody::Push {
    glm::vec3 wrist{};
    glm::vec3 elbow{};
    bool is_any = false;
};

PartnerBody::PartnerBody(const Girth& girth, const WorldPose& world) noexcept {
    const BodyCapsules body = body_capsules(girth, world);
    constexpr std::size_t kLeftTrunk = 0;
    constexpr std::size_t kRightTrunk = 4;
    constexpr std::size_t kHead = 8;
    const auto upper_arm = [&](Side side) {
        return Capsule{world.position(on_side(Bone::left_upper_arm, side)),
                       world.position(on_side(Bone::left_lower_arm, side)),
                       kUpperArm};
    };
    const std::array<Capsule, 6> capsules = {
        body[kLeftTrunk],
        body[kRightTrunk],
        {world.position(Bone::upper_chest), world.position(Bone::head), kNeck * girth.trunk},
        body[kHead],
        upper_arm(Side::left),
        upper_arm(Side::right)};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i] = part_of(capsules[i], i >= 4);
    }
    legs_ = {part_of(body[kLeftTrunk + 1], false),
             part_of(body[kLeftTrunk + 2], false),
             part_of(body[kRightTrunk + 1], false),
             part_of(body[kRightTrunk + 2], false)};
    middle_ = world.position(Bone::chest);
}

PartnerBody::Part PartnerBody::part_of(const Capsule& capsule, bool is_arm) noexcept {
    return {capsule,
            0.5F * (capsule.from + capsule.to),
            0.5F * glm::distance(capsule.from, capsule.to) + capsule.radius,
            is_arm};
}

bool PartnerBody::is_near(const Part& part, const Capsule& own, float spare) noexcept {
    const glm::vec3 between = 0.5F * (own.from + own.to) - part.middle;
    const float reach =
        0.5F * glm::distance(own.from, own.to) + own.radius + part.radius + spare + kSoft;
    return glm::dot(between, between) < reach * reach;
}

PartnerBody::Push PartnerBody::push_of(const Part& part,
                                       const Capsule& own,
                                       float spare,
                                       const glm::vec3& outward) const noexcept {
    if (!is_near(part, own, spare)) {
        return {};
    }
    const Nearness near = nearness(own, part.capsule);
    const float depth = soft_depth_of(spare - near.metres);
    if (depth <= 0.0F) {
        return {};
    }
    const glm::vec3 push = depth * unit(near.away + kOutward * outward, outward);
    return {near.at * push, (1.0F - near.at) * push, true};
}

void PartnerBody::add_push(const Part& part,
                           const std::array<Capsule, 2>& arm,
                           float spare,
                           const glm::vec3& outward,
                           float share,
                           Push& sum) const noexcept {
    const Push forearm = push_of(part, arm[0], spare, outward);
    const Push hand = push_of(part, arm[1], spare, outward);
    if (share <= 0.0F || (!forearm.is_any && !hand.is_any)) {
        return;
    }
    // At the middle of the forearm half of a push each would be too little.
    const float both =
        glm::dot(forearm.wrist, forearm.wrist) + glm::dot(forearm.elbow, forearm.elbow);
    const float whole = glm::length(forearm.wrist) + glm::length(forearm.elbow);
    const float gain = both > 0.0F ? whole * whole / both : 1.0F;
    const glm::vec3 by_hand = hand.wrist + hand.elbow;
    const glm::vec3 by_forearm = gain * forearm.wrist;
    // Whichever asks for more.
    const float one = glm::dot(by_hand, by_hand);
    const float other = glm::dot(by_forearm, by_forearm);
    sum.wrist +=
        share * (one * by_hand + other * by_forearm) / std::max(one + other, kLeast * kLeast);
    sum.elbow += share * gain * forearm.elbow;
    sum.is_any = true;
}

void move_arms(const Skeleton& skeleton,
               const ArmWays& ways,
               Pose& pose) noexcept RAKS_NONBLOCKING {
    const float most = std::max({glm::length(ways[0].wrist),
                                 glm::length(ways[0].elbow),
                                 glm::length(ways[1].wrist),
                                 glm::length(ways[1].elbow)});
    if (most < kLeast) {
        return;
    }
    const WorldPose world = world_body(skeleton, pose);
    for (const Side side : kSides) {
        const ArmWay& way = ways[static_cast<std::size_t>(side)];
        const Limb arm = arm_of(world, side);
        solve_limb(skeleton, arm, world.position(arm.end) + way.wrist, pose);
        turn_elbow(skeleton, arm, world.position(arm.lower) + way.elbow - arm.root, 1.0F, pose);
    }
}

ArmWays PartnerBody::ways_off(const Skeleton& skeleton,
                              const std::array<float, 2>& lying,
                              const Pose& danced) const noexcept RAKS_NONBLOCKING {
    ArmWays ways{};
    Pose pose = danced;
    WorldPose world = world_body(skeleton, pose);
    const glm::vec3 outward =
        unit(world.position(Bone::chest) - middle_, glm::vec3(0.0F, 0.0F, 1.0F));
    const float arm_length = glm::length(skeleton.offsets[index_of(Bone::left_lower_arm)]) +
                             glm::length(skeleton.offsets[index_of(Bone::left_hand)]);
    // Farther away nothing of either reaches the other.
    constexpr float kBodies = 0.7F;  // metres: half trunks and hands
    if (glm::distance(world.position(Bone::chest), middle_) > arm_length + kBodies) {
        return ways;
    }
    for (const Side side : kSides) {
        const float lies = lying[static_cast<std::size_t>(side)];
        const float spare = kSpare + lies * (kLying - kSpare);
        const glm::vec3 hand = world.position(on_side(Bone::left_hand, side));
        const glm::vec3 elbow = world.position(on_side(Bone::left_lower_arm, side));
        for (int round = 0; round < kRounds; ++round) {
            const ArmSkin skin(skeleton.girth, world, side);
            Push sum;
            for (const Part& part : parts_) {
                // What lies on an arm, or under it, is held there by both.
                add_push(part, skin.parts, spare, outward, part.is_arm ? 1.0F - lies : 1.0F, sum);
            }
            for (const std::size_t thigh : {0U, 2U}) {
                add_push(legs_[thigh], skin.parts, spare, outward, 1.0F, sum);
            }
            if (!sum.is_any) {
                break;
            }
            const Limb arm = arm_of(world, side);
            solve_limb(skeleton, arm, world.position(arm.end) + sum.wrist, pose);
            turn_elbow(skeleton, arm, world.position(arm.lower) + sum.elbow - arm.root, 1.0F, pose);
            world = world_body(skeleton, pose);
        }
        ways[static_cast<std::size_t>(side)] = {
            world.position(on_side(Bone::left_hand, side)) - hand,
            world.position(on_side(Bone::left_lower_arm, side)) - elbow};
    }
    return ways;
}

/// Metres that a bone of a leg must go aside to be clear of a part, at its knee.
float PartnerBody::way_aside(const Part& part,
                             const Capsule& own,
                             bool is_thigh,
                             const glm::vec3& aside) const noexcept {
    if (!is_near(part, own, kKnees)) {
        return 0.0F;
    }
    const Nearness near = nearness(own, part.capsule);
    const float depth = soft_depth_of(kKnees - near.metres);
    if (depth <= 0.0F) {
        return 0.0F;
    }
    const float now = glm::dot(near.away, aside);
    const float axes = glm::length(near.away);
    const float rest = std::max(0.0F, axes * axes - now * now);
    const float there = std::sqrt(std::max(0.0F, (axes + depth) * (axes + depth) - rest));
    // A thigh turns about its hip, a shin about its foot: the knee goes farther than the contact.
    const float lever = std::max(kLeastLever, is_thigh ? near.at : 1.0F - near.at);
    return kMostKnee * std::tanh(std::max(0.0F, there - now) / (lever * kMostKnee));
}

void PartnerBody::turn_knees(const Skeleton& skeleton,
                             const WorldPose& world,
                             float share,
                             Pose& pose) const noexcept RAKS_NONBLOCKING {
    for (const Side side : kSides) {
        Limb leg;
        leg.upper = on_side(Bone::left_upper_leg, side);
        leg.lower = on_side(Bone::left_lower_leg, side);
        leg.end = on_side(Bone::left_foot, side);
        leg.root = world.position(leg.upper);
        leg.parent = world.rotation(Bone::hips);
        const glm::vec3& knee = world.position(leg.lower);
        const Capsule thigh{leg.root, knee, skeleton.girth.thigh};
        const Capsule shin{knee, world.position(leg.end), skeleton.girth.shin};
        const glm::vec3 left = leg.parent * glm::vec3(1.0F, 0.0F, 0.0F);
        glm::vec3 push{};
        for (std::size_t i = 0; i < legs_.size(); ++i) {
            // Each stays on the side of the other that its hip is on.
            const glm::vec3& other = legs_[i - i % 2].capsule.from;
            const glm::vec3 aside = glm::dot(leg.root - other, left) > 0.0F ? left : -left;
            push += (way_aside(legs_[i], thigh, true, aside) +
                     way_aside(legs_[i], shin, false, aside)) *
                    aside;
        }
        if (glm::dot(push, push) < kLeast * kLeast) {
            continue;
        }
        turn_elbow(skeleton, leg, knee + push - leg.root, share, pose);
        const glm::quat lower = leg.parent * pose.rotation(leg.upper) * pose.rotation(leg.lower);
        pose.rotation(leg.end) = glm::normalize(glm::conjugate(lower) * world.rotation(leg.end));
    }
}

}  // namespace raks::motion
