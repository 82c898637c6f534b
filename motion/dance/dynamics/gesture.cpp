#include "motion/dance/dynamics/gesture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/smooth_steps.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

using ShapeChannel = float BodyShape::*;
/// Channels that the mirror leaves as they are.
constexpr std::array<ShapeChannel, 7> kUnpaired = {&BodyShape::drop,
                                                   &BodyShape::ahead,
                                                   &BodyShape::lean,
                                                   &BodyShape::chest,
                                                   &BodyShape::bow,
                                                   &BodyShape::head_nod,
                                                   &BodyShape::shoulders};
/// Channels that change their sign in the mirror.
constexpr std::array<ShapeChannel, 6> kTurnedOver = {&BodyShape::weight,
                                                     &BodyShape::hips_turn,
                                                     &BodyShape::side,
                                                     &BodyShape::twist,
                                                     &BodyShape::head_turn,
                                                     &BodyShape::head_tilt};
/// Channels of the left and of the right.
constexpr std::array<std::array<ShapeChannel, 2>, 7> kPairs = {
    {{&BodyShape::left_out, &BodyShape::right_out},
     {&BodyShape::left_fore, &BodyShape::right_fore},
     {&BodyShape::left_bend, &BodyShape::right_bend},
     {&BodyShape::left_toes, &BodyShape::right_toes},
     {&BodyShape::left_heel, &BodyShape::right_heel},
     {&BodyShape::left_shake, &BodyShape::right_shake},
     {&BodyShape::left_wave, &BodyShape::right_wave}}};
static_assert((kUnpaired.size() + kTurnedOver.size() + 2 * kPairs.size()) * sizeof(float) ==
              sizeof(BodyShape));

constexpr float kWeightShift = 0.065F;  // metres to the leg that carries
constexpr float kWeightRoll = 0.090F;   // radians of the hips
constexpr float kBowTurn = 0.26F;       // radians of hips, and of each bone of the spine the half

constexpr glm::vec3 kAcross{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kUpright{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 kFore{0.0F, 0.0F, 1.0F};

/// Turns a bone in the frame of the one that it hangs on.
void turn_bone_in_parent(Bone bone, float radians, const glm::vec3& axis, Pose& pose) noexcept {
    pose.rotation(bone) = glm::angleAxis(radians, axis) * pose.rotation(bone);
}
void turn_bone(Bone bone, float radians, const glm::vec3& axis, Pose& pose) noexcept {
    pose.rotation(bone) = pose.rotation(bone) * glm::angleAxis(radians, axis);
}

void shape_trunk(const BodyShape& shape, Pose& pose) noexcept {
    const glm::quat hips = pose.rotation(Bone::hips);
    pose.hips_position +=
        hips * glm::vec3(kWeightShift * shape.weight,
                         -shape.drop - 0.15F * kWeightShift * shape.weight * shape.weight,
                         shape.ahead - 0.25F * kBowTurn * shape.bow);
    pose.hips_position.y -= 0.03F * kBowTurn * shape.bow;
    turn_bone(Bone::hips, shape.hips_turn, kUpright, pose);
    turn_bone(Bone::hips, -kWeightRoll * shape.weight, kFore, pose);
    turn_bone(Bone::hips, kBowTurn * shape.bow, kAcross, pose);
    turn_bone_in_parent(Bone::spine, 0.7F * kWeightRoll * shape.weight, kFore, pose);
    for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest}) {
        turn_bone(bone, shape.lean / 3.0F + 0.6F * kBowTurn * shape.bow, kAcross, pose);
        turn_bone(bone, -shape.side / 3.0F, kFore, pose);
        turn_bone(bone, shape.twist / 3.0F, kUpright, pose);
    }
    turn_bone(Bone::chest, -0.6F * shape.chest, kAcross, pose);
    turn_bone(Bone::upper_chest, -0.4F * shape.chest, kAcross, pose);
    for (const Bone bone : {Bone::neck, Bone::head}) {
        turn_bone(bone, 0.5F * shape.head_turn, kUpright, pose);
        turn_bone(bone, 0.5F * (shape.head_nod + 0.6F * shape.chest), kAcross, pose);
        turn_bone(bone, -0.5F * shape.head_tilt, kFore, pose);
    }
    turn_bone(Bone::neck, 0.6F * kBowTurn * shape.bow, kAcross, pose);
}

void shape_arms(const BodyShape& shape, Pose& pose) noexcept {
    const std::array<float, 2> out = {shape.left_out, shape.right_out};
    const std::array<float, 2> fore = {shape.left_fore, shape.right_fore};
    const std::array<float, 2> bend = {shape.left_bend, shape.right_bend};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const float sign = side == Side::left ? 1.0F : -1.0F;
        turn_bone_in_parent(
            on_side(Bone::left_shoulder, side), sign * shape.shoulders, kFore, pose);
        const Bone upper = on_side(Bone::left_upper_arm, side);
        turn_bone_in_parent(upper, sign * out[s], kFore, pose);
        turn_bone_in_parent(upper, -fore[s], kAcross, pose);
        turn_bone(on_side(Bone::left_lower_arm, side), -sign * bend[s], kUpright, pose);
    }
}

/// The foot turned up about its heel or its ball, which stay where they are.
FootTarget turned_foot(const Skeleton& skeleton,
                       Side side,
                       const FootTarget& stands,
                       float toes,
                       float heel) noexcept {
    constexpr float kHeelBehind = 0.04F;  // metres behind the ankle
    const glm::vec3 to_heel = stands.rotation * glm::vec3(0.0F, 0.0F, -kHeelBehind) -
                              glm::vec3(0.0F, stands.ankle.y, 0.0F);
    FootTarget up;
    up.rotation = stands.rotation * glm::angleAxis(heel - toes, kAcross);
    const glm::quat about_heel =
        stands.rotation * glm::angleAxis(-toes, kAcross) * glm::conjugate(stands.rotation);
    up.ankle = stands.ankle + to_heel - about_heel * to_heel;
    if (heel > 0.0F) {
        up.ankle += pivot_from_ankle(skeleton, side, stands.rotation) -
                    pivot_from_ankle(skeleton, side, up.rotation);
    }
    return up;
}

}  // namespace

BodyShape mirrored(const BodyShape& shape) noexcept RAKS_NONBLOCKING {
    BodyShape other = shape;
    for (const ShapeChannel channel : kTurnedOver) {
        other.*channel = -(shape.*channel);
    }
    for (const auto& [left, right] : kPairs) {
        other.*left = shape.*right;
        other.*right = shape.*left;
    }
    return other;
}

BodyShape mix(const BodyShape& from, const BodyShape& to, float share) noexcept RAKS_NONBLOCKING {
    BodyShape shape;
    const auto go = [&](ShapeChannel channel) {
        shape.*channel = from.*channel + share * (to.*channel - from.*channel);
    };
    std::for_each(kUnpaired.begin(), kUnpaired.end(), go);
    std::for_each(kTurnedOver.begin(), kTurnedOver.end(), go);
    for (const auto& pair : kPairs) {
        std::for_each(pair.begin(), pair.end(), go);
    }
    return shape;
}

BodyShape shape_at(const Gesture& gesture,
                   const BodyShape& from,
                   double seconds) noexcept RAKS_NONBLOCKING {
    GestureKey before{0.0F, from};
    const auto time = static_cast<float>(seconds);
    for (const GestureKey& key : gesture.keys) {
        if (time < key.seconds) {
            return mix(before.shape, key.shape, smootherstep(before.seconds, key.seconds, time));
        }
        before = key;
    }
    return before.shape;
}

void apply_shape(const Skeleton& skeleton,
                 const BodyShape& shape,
                 Pose& pose) noexcept RAKS_NONBLOCKING {
    const WorldPose stands = world_body(skeleton, pose);
    shape_trunk(shape, pose);
    shape_arms(shape, pose);
    const std::array<float, 2> toes = {shape.left_toes, shape.right_toes};
    const std::array<float, 2> heels = {shape.left_heel, shape.right_heel};
    std::array<FootTarget, 2> feet;
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const Bone foot = on_side(Bone::left_foot, side);
        feet[s] = turned_foot(
            skeleton, side, {stands.position(foot), stands.rotation(foot)}, toes[s], heels[s]);
        turn_bone(on_side(Bone::left_toes, side), -heels[s], kAcross, pose);
    }
    lower_to_reach(skeleton, {feet[0].ankle, feet[1].ankle}, pose);
    for (const Side side : kSides) {
        solve_leg(skeleton, side, feet[static_cast<std::size_t>(side)], pose);
    }
}

void shake_hands(const BodyShape& shape, double turns, Pose& pose) noexcept RAKS_NONBLOCKING {
    const auto swing = static_cast<float>(std::sin(2.0 * M_PI * turns));
    const std::array<float, 2> shake = {shape.left_shake, shape.right_shake};
    const std::array<float, 2> wave = {shape.left_wave, shape.right_wave};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const float sign = side == Side::left ? 1.0F : -1.0F;
        turn_bone(on_side(Bone::left_hand, side), sign * shake[s] * swing, kFore, pose);
        turn_bone(on_side(Bone::left_upper_arm, side), wave[s] * swing, kAcross, pose);
    }
}

}  // namespace raks::motion
