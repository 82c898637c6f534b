#include "motion/dance/baking/hand_meeting.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

// Metres between palms: so near they meet, and from so far on they begin to.
constexpr float kMeeting = 0.08F;
constexpr float kApproach = 0.6F;
// Between the middles of two palms that touch; and how far from that it is felt.
constexpr float kPalms = 0.035F;
constexpr float kMeetingSoft = 0.015F;
constexpr int kMeetingRounds = 2;  // the hand turns with its forearm, and the palm with it

glm::vec3 palm(const WorldPose& world, Side side) noexcept {
    return 0.5F * (world.position(on_side(Bone::left_hand, side)) +
                   world.position(on_side(Bone::left_middle_proximal, side)));
}

/// From the left palm to the right one, as the chest sees it.
glm::vec3 between_palms(const WorldPose& world) noexcept {
    return glm::conjugate(world.rotation(Bone::upper_chest)) *
           (palm(world, Side::right) - palm(world, Side::left));
}

/// 1: the hands meet; 0: they have nothing to do with one another.
float nearness_of(const glm::vec3& between) noexcept {
    const float t =
        std::clamp((kApproach - glm::length(between)) / (kApproach - kMeeting), 0.0F, 1.0F);
    return t * t * t * (10.0F - t * (15.0F - 6.0F * t));
}

/// The same, but for hands that would be in one another: the right one stays to the right.
glm::vec3 side_by_side(glm::vec3 between) noexcept {
    const float spare = -between.x - kPalms;
    between.x = -kPalms - 0.5F * (spare + std::sqrt(spare * spare + kMeetingSoft * kMeetingSoft));
    return between;
}

void move_hands(const Skeleton& skeleton, const glm::vec3& wanted, float share, Pose& pose) {
    for (int round = 0; round < kMeetingRounds; ++round) {
        const WorldPose world = world_pose(skeleton, pose);
        const glm::quat& chest = world.rotation(Bone::upper_chest);
        const glm::vec3 right = chest * (0.5F * share * (wanted - between_palms(world)));
        for (const Side side : kSides) {
            const Limb arm = arm_of(world, side);
            const glm::vec3 way = side == Side::right ? right : -right;
            solve_limb(skeleton, arm, world.position(arm.end) + way, pose);
        }
    }
}

}  // namespace

void meet_hands(const Skeleton& skeleton, std::span<const Pose> learnt, std::span<Pose> varied) {
    std::vector<glm::vec3> between;
    between.reserve(learnt.size());
    for (const Pose& pose : learnt) {
        between.push_back(between_palms(world_pose(skeleton, pose)));
    }
    const bool meet = std::any_of(between.begin(), between.end(), [](const glm::vec3& apart) {
        return glm::length(apart) < kMeeting;
    });
    for (std::size_t i = 0; meet && i < std::min(learnt.size(), varied.size()); ++i) {
        const float share = nearness_of(between[i]);
        if (share > 0.0F) {
            move_hands(skeleton, side_by_side(between[i]), share, varied[i]);
        }
    }
}

}  // namespace raks::motion
