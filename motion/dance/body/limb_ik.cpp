#include "motion/dance/body/limb_ik.hpp"

#include <algorithm>
#include <cmath>

#include "motion/dance/body/curves.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kTiny = 1e-6F;
// Distance of knee or elbow from the limb's line, metres, below which its side is uncertain. (At
// 0.04, an arm thrown down nearly straight had its elbow pulled back and released within seven
// frames, 4,332 m/s^3.)
constexpr float kStraight = 0.02F;

}  // namespace

glm::quat rotation_between(const glm::vec3& from, const glm::vec3& to) noexcept RAKS_NONBLOCKING {
    const glm::vec3 a = glm::normalize(from);
    const glm::vec3 b = glm::normalize(to);
    const float w = 1.0F + glm::dot(a, b);
    if (w < kTiny) {
        // Opposite directions: half a turn about an axis square to them, x where that is square.
        const glm::vec3 near = std::abs(a.x) < 0.9F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
        return glm::angleAxis(3.14159265F, glm::normalize(near - a * glm::dot(a, near)));
    }
    const glm::vec3 axis = glm::cross(a, b);
    return glm::normalize(glm::quat(w, axis.x, axis.y, axis.z));
}

Limb arm_of(const WorldPose& world, Side side) noexcept RAKS_NONBLOCKING {
    Limb arm;
    arm.upper = on_side(Bone::left_upper_arm, side);
    arm.lower = on_side(Bone::left_lower_arm, side);
    arm.end = on_side(Bone::left_hand, side);
    arm.root = world.position(arm.upper);
    arm.parent = world.rotation(on_side(Bone::left_shoulder, side));
    arm.ahead = world.rotation(arm.upper) * glm::vec3(0.0F, 0.0F, -1.0F);
    return arm;
}

glm::quat solve_limb(const Skeleton& skeleton,
                     const Limb& limb,
                     const glm::vec3& target,
                     Pose& pose) noexcept RAKS_NONBLOCKING {
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
    // Law of cosines: the middle joint lies `along` the line and `aside` of it.
    const float along = (upper * upper - lower * lower + distance * distance) / (2.0F * distance);
    const float aside = std::sqrt(std::max(0.0F, upper * upper - along * along));
    // The middle joint's side: where it lies off the limb's present line, turned with that line;
    // `ahead` is mixed in, the more the straighter the limb is.
    const glm::vec3 own_line = glm::normalize(upper_vector + lower_vector);
    const glm::vec3 own_pole = upper_vector - own_line * glm::dot(upper_vector, own_line);
    const float unknown = std::max(0.0F, 1.0F - glm::length(own_pole) / kStraight);
    glm::vec3 pole =
        rotation_between(own_line, line) * own_pole + kStraight * unknown * unknown * limb.ahead;
    pole = glm::normalize(pole - line * glm::dot(pole, line));

    const glm::vec3 new_upper = line * along + pole * aside;
    const glm::vec3 new_lower = line * distance - new_upper;
    // The upper bone takes the shortest turn, so it does not twist; the lower one follows it, then
    // bends.
    const glm::quat turn = rotation_between(upper_vector, new_upper);
    const glm::quat new_upper_world = glm::normalize(turn * upper_world);
    const glm::quat bend = rotation_between(turn * lower_vector, new_lower);
    const glm::quat new_lower_world = glm::normalize(bend * turn * lower_world);
    pose.rotation(limb.upper) = glm::normalize(glm::conjugate(limb.parent) * new_upper_world);
    pose.rotation(limb.lower) = glm::normalize(glm::conjugate(new_upper_world) * new_lower_world);
    return new_lower_world;
}

glm::vec3 pivot_from_ankle(const Skeleton& skeleton,
                           Side side,
                           const glm::quat& rotation) noexcept RAKS_NONBLOCKING {
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

float foot_heading(const glm::quat& rotation) noexcept RAKS_NONBLOCKING {
    const glm::vec3 ahead = rotation * glm::vec3(0.0F, 0.0F, 1.0F);
    return std::atan2(ahead.x, ahead.z);
}

FootPlace foot_place(const Skeleton& skeleton,
                     const WorldPose& world,
                     Side side) noexcept RAKS_NONBLOCKING {
    const Bone foot = on_side(Bone::left_foot, side);
    const glm::quat& rotation = world.rotation(foot);
    return {world.position(foot) + pivot_from_ankle(skeleton, side, rotation), rotation};
}

float leg_length(const Skeleton& skeleton) noexcept {
    return glm::length(skeleton.offsets[index_of(Bone::left_lower_leg)]) +
           glm::length(skeleton.offsets[index_of(Bone::left_foot)]);
}

void solve_leg(const Skeleton& skeleton,
               Side side,
               const FootTarget& target,
               Pose& pose) noexcept RAKS_NONBLOCKING {
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

void lower_to_reach(const Skeleton& skeleton,
                    const std::array<glm::vec3, 2>& ankles,
                    Pose& pose) noexcept RAKS_NONBLOCKING {
    constexpr float kSoftReach = 0.01F;  // metres
    const float reach = kLongestReach * leg_length(skeleton);
    float lower = 0.0F;
    for (const Side side : kSides) {
        const glm::vec3 hip = pose.hips_position +
                              pose.rotation(Bone::hips) *
                                  skeleton.offsets[index_of(on_side(Bone::left_upper_leg, side))];
        const glm::vec3 leg = hip - ankles[static_cast<std::size_t>(side)];
        const float aside = leg.x * leg.x + leg.z * leg.z;
        const float most = std::sqrt(std::max(0.04F * reach * reach, reach * reach - aside));
        lower = soft_max(lower, leg.y - most, kSoftReach);
    }
    pose.hips_position.y -= lower;
}

float lowest_of_sole(const Skeleton& skeleton,
                     Side side,
                     const glm::quat& foot_rotation,
                     const glm::quat& toes_rotation) noexcept RAKS_NONBLOCKING {
    const glm::vec3& toes = skeleton.offsets[index_of(Bone::left_toes)];
    const glm::quat mirrored_toes =
        side == Side::left
            ? toes_rotation
            : glm::quat(toes_rotation.w, toes_rotation.x, -toes_rotation.y, -toes_rotation.z);
    const glm::vec3 toe_tip = toes + mirrored_toes * (skeleton.toe_tip - toes);
    // The skeleton stores the left sole; the right one is its mirror image.
    float lowest = 1e9F;
    // A foot that is rolled stands on the edge of its sole.
    const float edge = skeleton.sole_half * std::abs((foot_rotation * glm::vec3(1, 0, 0)).y);
    for (glm::vec3 point : {skeleton.ball, toe_tip, skeleton.heel}) {
        if (side == Side::right) {
            point.x = -point.x;
        }
        lowest = std::min(lowest, (foot_rotation * point).y);
    }
    return lowest - edge;
}

void put_feet_as(const Skeleton& skeleton,
                 const Pose& other,
                 Pose& pose) noexcept RAKS_NONBLOCKING {
    const WorldPose world = world_body(skeleton, other);
    std::array<glm::vec3, 2> ankles{};
    for (const Side side : kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        const float standing = -lowest_of_sole(
            skeleton, side, world.rotation(foot), pose.rotation(on_side(Bone::left_toes, side)));
        glm::vec3& ankle = ankles[static_cast<std::size_t>(side)];
        ankle = world.position(foot);
        ankle.y = std::max(ankle.y, standing);
    }
    lower_to_reach(skeleton, ankles, pose);
    for (const Side side : kSides) {
        const Bone foot = on_side(Bone::left_foot, side);
        solve_leg(
            skeleton, side, {ankles[static_cast<std::size_t>(side)], world.rotation(foot)}, pose);
    }
}

void lift_feet(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING {
    const WorldPose world = world_body(skeleton, pose);
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
