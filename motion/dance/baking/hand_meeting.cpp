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

// Distances between palms, metres: below the first they meet; below the second they begin to.
constexpr float kMeeting = 0.08F;
constexpr float kApproach = 0.6F;
// Distance between the middles of two touching palms, and the softness of that limit; metres.
constexpr float kPalms = 0.035F;
constexpr float kMeetingSoft = 0.015F;
constexpr int kMeetingRounds = 2;  // the palm turns with the forearm, so one round falls short

// Middle of the palm: between the wrist and the middle finger's first joint.
glm::vec3 palm(const WorldPose& world, Side side) noexcept {
    return 0.5F * (world.position(on_side(Bone::left_hand, side)) +
                   world.position(on_side(Bone::left_middle_proximal, side)));
}

/// Vector from the left palm to the right one, in the chest's frame.
glm::vec3 between_palms(const WorldPose& world) noexcept {
    return glm::conjugate(world.rotation(Bone::upper_chest)) *
           (palm(world, Side::right) - palm(world, Side::left));
}

/// Weight of the meeting, smootherstep of the distance: 1 when the hands meet, 0 beyond kApproach.
float nearness_of(const glm::vec3& between) noexcept {
    const float t =
        std::clamp((kApproach - glm::length(between)) / (kApproach - kMeeting), 0.0F, 1.0F);
    return t * t * t * (10.0F - t * (15.0F - 6.0F * t));
}

/// The same vector, but with the right palm at least kPalms to the right of the left one (x is
/// left), softly.
glm::vec3 side_by_side(glm::vec3 between) noexcept {
    const float spare = -between.x - kPalms;
    between.x = -kPalms - 0.5F * (spare + std::sqrt(spare * spare + kMeetingSoft * kMeetingSoft));
    return between;
}

// Moves each palm by half of what is missing to `wanted`, weighted by `share`.
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
