// Humanoid: bones, their names and parents, and the two sides of a body.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raks::motion {

/// The 52 humanoid bones, named as in VRM 1.0 (without eyes and jaw). A parent always comes before
/// its children; left before right. This is the order of every array over bones.
enum class Bone : std::uint8_t {
    hips,
    spine,
    chest,
    upper_chest,
    neck,
    head,
    left_upper_leg,
    left_lower_leg,
    left_foot,
    left_toes,
    left_shoulder,
    left_upper_arm,
    left_lower_arm,
    left_hand,
    left_thumb_metacarpal,
    left_thumb_proximal,
    left_thumb_distal,
    left_index_proximal,
    left_index_intermediate,
    left_index_distal,
    left_middle_proximal,
    left_middle_intermediate,
    left_middle_distal,
    left_ring_proximal,
    left_ring_intermediate,
    left_ring_distal,
    left_little_proximal,
    left_little_intermediate,
    left_little_distal,
    right_upper_leg,
    right_lower_leg,
    right_foot,
    right_toes,
    right_shoulder,
    right_upper_arm,
    right_lower_arm,
    right_hand,
    right_thumb_metacarpal,
    right_thumb_proximal,
    right_thumb_distal,
    right_index_proximal,
    right_index_intermediate,
    right_index_distal,
    right_middle_proximal,
    right_middle_intermediate,
    right_middle_distal,
    right_ring_proximal,
    right_ring_intermediate,
    right_ring_distal,
    right_little_proximal,
    right_little_intermediate,
    right_little_distal,
};
inline constexpr int kBoneCount = 52;  ///< number of bones

/// Index in arrays by bone.
[[nodiscard]] constexpr std::size_t index_of(Bone bone) noexcept {
    return static_cast<std::size_t>(bone);
}

/// VRM 1.0 names ("leftUpperLeg").
inline constexpr std::array<std::string_view, kBoneCount> kBoneNames = {
    "hips",
    "spine",
    "chest",
    "upperChest",
    "neck",
    "head",
    "leftUpperLeg",
    "leftLowerLeg",
    "leftFoot",
    "leftToes",
    "leftShoulder",
    "leftUpperArm",
    "leftLowerArm",
    "leftHand",
    "leftThumbMetacarpal",
    "leftThumbProximal",
    "leftThumbDistal",
    "leftIndexProximal",
    "leftIndexIntermediate",
    "leftIndexDistal",
    "leftMiddleProximal",
    "leftMiddleIntermediate",
    "leftMiddleDistal",
    "leftRingProximal",
    "leftRingIntermediate",
    "leftRingDistal",
    "leftLittleProximal",
    "leftLittleIntermediate",
    "leftLittleDistal",
    "rightUpperLeg",
    "rightLowerLeg",
    "rightFoot",
    "rightToes",
    "rightShoulder",
    "rightUpperArm",
    "rightLowerArm",
    "rightHand",
    "rightThumbMetacarpal",
    "rightThumbProximal",
    "rightThumbDistal",
    "rightIndexProximal",
    "rightIndexIntermediate",
    "rightIndexDistal",
    "rightMiddleProximal",
    "rightMiddleIntermediate",
    "rightMiddleDistal",
    "rightRingProximal",
    "rightRingIntermediate",
    "rightRingDistal",
    "rightLittleProximal",
    "rightLittleIntermediate",
    "rightLittleDistal",
};

/// Index of the parent bone; hips, the root, is its own parent.
inline constexpr std::array<std::uint8_t, kBoneCount> kBoneParents = {
    0,  0,  1,  2,  3,  4,  0,  6,  7,  8,  3,  10, 11, 12, 13, 14, 15, 13,
    17, 18, 13, 20, 21, 13, 23, 24, 13, 26, 27, 0,  29, 30, 31, 3,  33, 34,
    35, 36, 37, 38, 36, 40, 41, 36, 43, 44, 36, 46, 47, 36, 49, 50,
};

/// A side of the body, seen by the figure itself.
enum class Side : std::uint8_t { left, right };
/// Both sides, in the order of arrays "by Side".
inline constexpr std::array<Side, 2> kSides = {Side::left, Side::right};

/// The bone on the other side of the body; bones of the trunk are their own mirror image.
[[nodiscard]] constexpr Bone mirrored(Bone bone) noexcept {
    constexpr int kFirstLeft = static_cast<int>(Bone::left_upper_leg);
    constexpr int kFirstRight = static_cast<int>(Bone::right_upper_leg);
    constexpr int kShift = kFirstRight - kFirstLeft;
    const int i = static_cast<int>(bone);
    if (i < kFirstLeft) {
        return bone;
    }
    return static_cast<Bone>(i < kFirstRight ? i + kShift : i - kShift);
}

/// `left` on Side::left, its mirror on Side::right: `on_side(Bone::left_foot, side)`.
[[nodiscard]] constexpr Bone on_side(Bone left, Side side) noexcept {
    return side == Side::left ? left : mirrored(left);
}

}  // namespace raks::motion
