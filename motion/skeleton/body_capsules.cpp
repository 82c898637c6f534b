#include "motion/skeleton/body_capsules.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace raks::motion {

BodyCapsules body_capsules(const Girth& girth, const WorldPose& world) noexcept RAKS_NONBLOCKING {
    BodyCapsules capsules;
    std::size_t at = 0;
    for (const Side side : kSides) {
        const float aside = side == Side::left ? girth.flank : -girth.flank;
        const auto joint = [&](Bone left) { return world.position(on_side(left, side)); };
        capsules[at++] = {
            world.point(Bone::hips, {aside, 0.0F, girth.trunk_ahead}),
            world.point(Bone::upper_chest, {aside, girth.chest_height, girth.trunk_ahead}),
            girth.trunk};
        capsules[at++] = {joint(Bone::left_upper_leg), joint(Bone::left_lower_leg), girth.thigh};
        capsules[at++] = {joint(Bone::left_lower_leg), joint(Bone::left_foot), girth.shin};
        capsules[at++] = {joint(Bone::left_foot), joint(Bone::left_toes), 0.5F * girth.shin};
    }
    capsules[at] = {world.position(Bone::neck),
                    world.point(Bone::head, {0.0F, girth.head_height, 0.0F}),
                    girth.head};
    return capsules;
}

// Nearest points of two segments: Ericson 2005, "Real-Time Collision Detection", 5.1.9.
Nearness nearness(const Capsule& one, const Capsule& other) noexcept RAKS_NONBLOCKING {
    const glm::vec3 a = one.to - one.from;
    const glm::vec3 b = other.to - other.from;
    const glm::vec3 between = one.from - other.from;
    const float aa = glm::dot(a, a);
    const float bb = glm::dot(b, b);
    const float ab = glm::dot(a, b);
    const float ac = glm::dot(a, between);
    const float bc = glm::dot(b, between);
    const float slant = aa * bb - ab * ab;
    constexpr float kParallel = 1e-9F;
    // Parameter on the first segment; any will do for parallel ones.
    const float first =
        slant > kParallel ? std::clamp((ab * bc - ac * bb) / slant, 0.0F, 1.0F) : 0.0F;
    // Clamped on the second one, then the first is computed again for that.
    const float free = (ab * first + bc) / bb;
    const float second = std::clamp(free, 0.0F, 1.0F);
    const float s = std::clamp((ab * second - ac) / aa, 0.0F, 1.0F);
    const glm::vec3 away = one.from + s * a - (other.from + second * b);
    return {away, glm::length(away) - one.radius - other.radius, s};
}

std::array<Capsule, 2> hand_capsules(const Girth& girth,
                                     const WorldPose& world,
                                     Side side) noexcept RAKS_NONBLOCKING {
    const auto joint = [&](Bone left) { return world.position(on_side(left, side)); };
    const glm::vec3 wrist = joint(Bone::left_hand);
    return {{{glm::mix(joint(Bone::left_lower_arm), wrist, 0.5F), wrist, girth.forearm},
             {wrist, joint(Bone::left_middle_intermediate), girth.hand}}};
}

HandClearance hand_clearance(const Skeleton& skeleton, const Pose& pose) noexcept RAKS_NONBLOCKING {
    const WorldPose world = world_body(skeleton, pose);
    const BodyCapsules body = body_capsules(skeleton.girth, world);
    HandClearance least{Side::left, kBodyCapsuleNames[0], 1e9};
    for (const Side side : kSides) {
        for (const Capsule& hand : hand_capsules(skeleton.girth, world, side)) {
            for (std::size_t part = 0; part < body.size(); ++part) {
                const auto metres = static_cast<double>(nearness(hand, body[part]).metres);
                if (metres < least.metres) {
                    least = {side, kBodyCapsuleNames[part], metres};
                }
            }
        }
    }
    return least;
}

}  // namespace raks::motion
