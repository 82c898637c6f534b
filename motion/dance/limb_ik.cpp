#include "motion/dance/limb_ik.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/easing.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kTiny = 1e-6F;
constexpr float kStraight = 0.02F;  // metres of the knee beside the leg's line

// Hands that hold one another are no further apart by themselves; beyond the second they have let
// go. Metres. (Let go within 0.4 m, arms that pass through that range jerk: up to 7,000 m/s^3.)
constexpr float kHeld = 0.3F;
constexpr float kReleased = 1.3F;
constexpr float kGrip = 0.06F;  // between both wrists
// No nearer to the shoulder, of the arm's length (the elbow bent by 127 degrees), and how softly.
constexpr float kNearest = 0.45F;
constexpr float kNearestSoftly = 0.2F;
// No farther (by 37 degrees).
constexpr float kFarthest = 0.95F;
constexpr float kFarthestSoftly = 0.15F;

/// A hand's way to where both meet, as far as its own arm likes to go: nearer to the shoulder the
/// elbow would fly round, farther it would snap straight.
glm::vec3 within_reach(const WorldPose& world, const Limb& arm, const glm::vec3& target) noexcept {
    const glm::vec3 elbow = world.position(arm.lower);
    const glm::vec3 hand = world.position(arm.end);
    const float length = glm::distance(arm.root, elbow) + glm::distance(elbow, hand);
    const glm::vec3 line = target - arm.root;
    const float reach = glm::length(line);
    if (reach < kTiny) {
        return hand;
    }
    const float held = soft_max(reach, kNearest * length, kNearestSoftly * length);
    const float farthest = kFarthest * length;
    return arm.root - line * (soft_max(-held, -farthest, kFarthestSoftly * length) / reach);
}

}  // namespace

glm::quat rotation_between(const glm::vec3& from, const glm::vec3& to) noexcept {
    const glm::vec3 a = glm::normalize(from);
    const glm::vec3 b = glm::normalize(to);
    const float w = 1.0F + glm::dot(a, b);
    if (w < kTiny) {
        return glm::angleAxis(3.14159265F, glm::vec3(1, 0, 0));
    }
    const glm::vec3 axis = glm::cross(a, b);
    return glm::normalize(glm::quat(w, axis.x, axis.y, axis.z));
}

Limb arm_of(const WorldPose& world, Side side, const glm::vec3& ahead) noexcept {
    Limb arm;
    arm.upper = on_side(Bone::left_upper_arm, side);
    arm.lower = on_side(Bone::left_lower_arm, side);
    arm.end = on_side(Bone::left_hand, side);
    arm.root = world.position(arm.upper);
    arm.parent = world.rotation(on_side(Bone::left_shoulder, side));
    arm.ahead = ahead;
    return arm;
}

glm::quat solve_limb(const Skeleton& skeleton,
                     const Limb& limb,
                     const glm::vec3& target,
                     Pose& pose) noexcept {
    const glm::quat upper_world = limb.parent * pose.rotation(limb.upper);
    const glm::quat lower_world = upper_world * pose.rotation(limb.lower);
    const glm::vec3 upper_vector = upper_world * skeleton.offsets[index_of(limb.lower)];
    const glm::vec3 lower_vector = lower_world * skeleton.offsets[index_of(limb.end)];
    const float upper = glm::length(upper_vector);
    const float lower = glm::length(lower_vector);

    glm::vec3 line = target - limb.root;
    const float wanted = glm::length(line);
    if (wanted < kTiny) {
        return lower_world;
    }
    line /= wanted;
    const float distance =
        std::clamp(wanted, std::abs(upper - lower) + kTiny, kLongestReach * (upper + lower));
    const float along = (upper * upper - lower * lower + distance * distance) / (2.0F * distance);
    const float aside = std::sqrt(std::max(0.0F, upper * upper - along * along));
    // The middle joint's side: where it stands out from the limb's own line now, or ahead for a
    // straight limb.
    const glm::vec3 own_line = glm::normalize(upper_vector + lower_vector);
    glm::vec3 pole = upper_vector - own_line * glm::dot(upper_vector, own_line);
    if (glm::length(pole) < kStraight) {
        pole = limb.ahead;
    }
    pole -= line * glm::dot(pole, line);
    pole = glm::normalize(pole);

    const glm::vec3 new_upper = line * along + pole * aside;
    const glm::vec3 new_lower = line * distance - new_upper;
    const glm::quat turn = rotation_between(upper_vector, new_upper);
    const glm::quat new_upper_world = glm::normalize(turn * upper_world);
    const glm::quat bend = rotation_between(turn * lower_vector, new_lower);
    const glm::quat new_lower_world = glm::normalize(bend * turn * lower_world);
    pose.rotation(limb.upper) = glm::normalize(glm::conjugate(limb.parent) * new_upper_world);
    pose.rotation(limb.lower) = glm::normalize(glm::conjugate(new_upper_world) * new_lower_world);
    return new_lower_world;
}

void join_hands(const Skeleton& skeleton, Pose& lead, Pose& follow) noexcept {
    const WorldPose a = world_pose(skeleton, lead);
    const WorldPose b = world_pose(skeleton, follow);
    const glm::vec3 own = a.position(Bone::left_hand);
    const glm::vec3 other = b.position(Bone::right_hand);
    const float apart = glm::distance(own, other);
    if (apart < kGrip || apart > kReleased) {
        return;
    }
    const float t = std::clamp((kReleased - apart) / (kReleased - kHeld), 0.0F, 1.0F);
    const float hold = t * t * (3.0F - 2.0F * t);
    const glm::vec3 half_way = 0.5F * hold * (1.0F - kGrip / apart) * (other - own);
    constexpr glm::vec3 kDown{0.0F, -1.0F, 0.0F};
    const Limb left = arm_of(a, Side::left, kDown);
    const Limb right = arm_of(b, Side::right, kDown);
    solve_limb(skeleton, left, within_reach(a, left, own + half_way), lead);
    solve_limb(skeleton, right, within_reach(b, right, other - half_way), follow);
}

}  // namespace raks::motion
