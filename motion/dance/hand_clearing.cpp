#include "motion/dance/hand_clearing.hpp"

#include <array>

#include "motion/dance/limb_ik.hpp"
#include "motion/skeleton/body_capsules.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kSoft = 0.035F;  // metres: from here on a hand feels the body
// What decides where a hand goes that is deep inside, where the nearest skin says nothing; metres.
// Much less, and a hand that passes through the trunk turns from one skin to the other within a
// few ms: at 0.03 m with up to 8,200 m/s^3, at 0.12 m with 3,600 (salsa, lead and follow).
constexpr float kOutward = 0.12F;
constexpr int kRounds = 2;  // out of one part may be into another
constexpr float kLeastPush = 1e-5F;

/// `depth`, rounded where it begins; once differentiable, 0 below -kSoft.
float soft_depth(float depth) noexcept {
    if (depth <= -kSoft) {
        return 0.0F;
    }
    return depth >= kSoft ? depth : (depth + kSoft) * (depth + kSoft) / (4.0F * kSoft);
}

/// How far a hand must go.
glm::vec3 push_of(const std::array<Capsule, 2>& hand,
                  const BodyCapsules& body,
                  const glm::vec3& outward) noexcept {
    glm::vec3 push{};
    for (int round = 0; round < kRounds; ++round) {
        for (const Capsule& part : body) {
            for (Capsule moved : hand) {
                moved.from += push;
                moved.to += push;
                const Nearness near = nearness(moved, part);
                const float depth = soft_depth(-near.metres);
                if (depth > 0.0F) {
                    push += depth * glm::normalize(near.away + kOutward * outward);
                }
            }
        }
    }
    return push;
}

}  // namespace

void clear_hands(const Skeleton& skeleton, Pose& pose) noexcept {
    const WorldPose world = world_pose(skeleton, pose);
    const BodyCapsules body = body_capsules(world);
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        const glm::vec3 outward = world.rotation(Bone::hips) * glm::vec3(0.6F * sign, 0.0F, 0.8F);
        const glm::vec3 push = push_of(hand_capsules(world, side), body, outward);
        if (glm::dot(push, push) < kLeastPush * kLeastPush) {
            continue;
        }
        const Limb arm = arm_of(world, side, -outward);
        solve_limb(skeleton, arm, world.position(arm.end) + push, pose);
    }
}

}  // namespace raks::motion
