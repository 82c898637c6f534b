#include "motion/dance/body/leg_ik.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
glm::vec3 pivot_from_ankle(const Skeleton& skeleton,
                           Side side,
                           const glm::quat& rotation) noexcept {
    // Share of the toes' length ahead of the ball. At 0, the ball's joint itself, the tip of the
    // toes slips 3.1 cm where people's slips 2.4 (90th percentile).
    constexpr float kBeforeBall = 0.65F;
    // Cosine of the slope up to which the toes are laid flat; steeper ones are shortened
    constexpr float kSteepest = 0.5F;
    const glm::vec3 mirror{side == Side::left ? 1.0F : -1.0F, 1.0F, 1.0F};
    const glm::vec3 own_toes = skeleton.toe_tip - skeleton.ball;
    const float length = glm::length(own_toes);
    glm::vec3 toes = rotation * (mirror * own_toes);
    toes.y = 0.0F;
    // Their horizontal part, at full length up to that slope.
    toes *= length / std::max(glm::length(toes), kSteepest * length);
    return rotation * (mirror * skeleton.ball) + kBeforeBall * toes;
}

float leg_length(const Skeleton& skeleton) noexcept {
    return glm::length(skeleton.offsets[index_of(Bone::left_lower_leg)]) +
           glm::length(skeleton.offsets[index_of(Bone::left_foot)]);
}

void solve_leg(const Skeleton& skeleton, Side side, const FootTarget& target, Pose& pose) noexcept {
    const glm::quat hips = pose.rotation(Bone::hips);
    Limb leg;
    leg.upper = on_side(Bone::left_upper_leg, side);
    leg.lower = on_side(Bone::left_lower_leg, side);
    leg.end = on_side(Bone::left_foot, side);
    leg.root = pose.hips_position + hips * skeleton.offsets[index_of(leg.upper)];
    leg.parent = hips;
    leg.ahead = hips * glm::vec3(0, 0, 1);
    const glm::quat shin = solve_limb(skeleton, leg, target.ankle, pose);
    pose.rotation(leg.end) = glm::normalize(glm::conjugate(shin) * target.rotation);
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
    // The skeleton stores the left sole; the right one is its mirror image.
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
