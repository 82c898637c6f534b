#include "motion/dance/leg_ik.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kTiny = 1e-6F;
constexpr float kStraight = 0.02F;  // metres of the knee beside the leg's line

/// Shortest rotation that turns direction `from` to direction `to`.
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

}  // namespace

float leg_length(const Skeleton& skeleton) noexcept {
    return glm::length(skeleton.offsets[index_of(Bone::left_lower_leg)]) +
           glm::length(skeleton.offsets[index_of(Bone::left_foot)]);
}

void solve_leg(const Skeleton& skeleton, Side side, const FootTarget& target, Pose& pose) noexcept {
    const Bone thigh = on_side(Bone::left_upper_leg, side);
    const Bone shin = on_side(Bone::left_lower_leg, side);
    const Bone foot = on_side(Bone::left_foot, side);
    const glm::quat hips = pose.rotation(Bone::hips);
    const glm::vec3 hip = pose.hips_position + hips * skeleton.offsets[index_of(thigh)];
    const glm::quat thigh_world = hips * pose.rotation(thigh);
    const glm::quat shin_world = thigh_world * pose.rotation(shin);
    const glm::vec3 thigh_vector = thigh_world * skeleton.offsets[index_of(shin)];
    const glm::vec3 shin_vector = shin_world * skeleton.offsets[index_of(foot)];
    const float upper = glm::length(thigh_vector);
    const float lower = glm::length(shin_vector);

    glm::vec3 line = target.ankle - hip;
    const float wanted = glm::length(line);
    if (wanted < kTiny) {
        return;
    }
    line /= wanted;
    const float distance =
        std::clamp(wanted, std::abs(upper - lower) + kTiny, kLongestReach * (upper + lower));
    const float along = (upper * upper - lower * lower + distance * distance) / (2.0F * distance);
    const float aside = std::sqrt(std::max(0.0F, upper * upper - along * along));
    // The knee's side: where it stands out from the leg's own line now, or ahead for a straight
    // leg.
    const glm::vec3 own_line = glm::normalize(thigh_vector + shin_vector);
    glm::vec3 pole = thigh_vector - own_line * glm::dot(thigh_vector, own_line);
    const glm::vec3 ahead = hips * glm::vec3(0, 0, 1);
    if (glm::length(pole) < kStraight) {
        pole = ahead;
    }
    pole -= line * glm::dot(pole, line);
    pole = glm::normalize(pole);

    const glm::vec3 new_thigh = line * along + pole * aside;
    const glm::vec3 new_shin = line * distance - new_thigh;
    const glm::quat turn = rotation_between(thigh_vector, new_thigh);
    const glm::quat new_thigh_world = glm::normalize(turn * thigh_world);
    const glm::quat bend = rotation_between(turn * shin_vector, new_shin);
    const glm::quat new_shin_world = glm::normalize(bend * turn * shin_world);
    pose.rotation(thigh) = glm::normalize(glm::conjugate(hips) * new_thigh_world);
    pose.rotation(shin) = glm::normalize(glm::conjugate(new_thigh_world) * new_shin_world);
    pose.rotation(foot) = glm::normalize(glm::conjugate(new_shin_world) * target.rotation);
}

float lowest_of_sole(const Skeleton& skeleton,
                     Side side,
                     const glm::quat& foot_rotation,
                     const glm::quat& toes_rotation) noexcept {
    const glm::vec3& toes = skeleton.offsets[index_of(Bone::left_toes)];
    const glm::quat mirrored_toes =
        side == Side::left
            ? toes_rotation
            : glm::quat(toes_rotation.w, toes_rotation.x, -toes_rotation.y, -toes_rotation.z);
    const glm::vec3 toe_tip = toes + mirrored_toes * (skeleton.toe_tip - toes);
    float lowest = 1e9F;
    for (glm::vec3 point : {skeleton.ball, toe_tip, skeleton.heel}) {
        if (side == Side::right) {
            point.x = -point.x;
        }
        lowest = std::min(lowest, (foot_rotation * point).y);
    }
    return lowest;
}

void lift_feet(const Skeleton& skeleton, Pose& pose) noexcept {
    const WorldPose world = world_pose(skeleton, pose);
    for (const Side side : kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        FootTarget target{world.position(foot), world.rotation(foot)};
        const float standing = -lowest_of_sole(
            skeleton, side, target.rotation, pose.rotation(on_side(Bone::left_toes, side)));
        if (target.ankle.y < standing) {
            target.ankle.y = standing;
            solve_leg(skeleton, side, target, pose);
        }
    }
}

}  // namespace raks::motion
