// MMD bones: the bones of a body of MikuMikuDance, as its dances name them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// The standard and semi-standard bones that move a body. Of the limbs only the left ones are
/// spelled out: the right ones follow in the same order (on_side). A parent comes before its
/// children. English words for the Japanese names of mmd_name().
enum class MmdBone : std::uint8_t {
    mother,
    center,
    groove,
    waist,
    upper_body,
    upper_body2,
    upper_body3,
    neck,
    head,
    lower_body,
    left_shoulder_p,
    left_shoulder,
    left_shoulder_c,
    left_arm,
    left_arm_twist,
    left_elbow,
    left_wrist_twist,
    left_wrist,
    left_thumb0,
    left_thumb1,
    left_thumb2,
    left_index1,
    left_index2,
    left_index3,
    left_middle1,
    left_middle2,
    left_middle3,
    left_ring1,
    left_ring2,
    left_ring3,
    left_little1,
    left_little2,
    left_little3,
    left_waist_cancel,
    left_leg,
    left_knee,
    left_ankle,
    left_toe,
    left_leg_ik_parent,
    left_leg_ik,
    left_toe_ik,
    left_leg_d,
    left_knee_d,
    left_ankle_d,
    left_toe_ex,
};
inline constexpr std::size_t kMmdTrunkBones = 10;                             ///< the first ones
inline constexpr std::size_t kMmdSideBones = 35;                              ///< of each side
inline constexpr std::size_t kMmdBones = kMmdTrunkBones + 2 * kMmdSideBones;  ///< in all

/// Index in arrays by bone.
[[nodiscard]] constexpr std::size_t index_of(MmdBone bone) noexcept {
    return static_cast<std::size_t>(bone);
}
/// A left bone, or its mirror image: `on_side(MmdBone::left_leg, side)`.
[[nodiscard]] constexpr MmdBone on_side(MmdBone left, Side side) noexcept {
    return side == Side::left ? left : static_cast<MmdBone>(index_of(left) + kMmdSideBones);
}
/// The side of a limb's bone; the trunk has none.
[[nodiscard]] constexpr std::optional<Side> side_of(MmdBone bone) noexcept {
    if (index_of(bone) < kMmdTrunkBones) {
        return std::nullopt;
    }
    return index_of(bone) < kMmdTrunkBones + kMmdSideBones ? Side::left : Side::right;
}
/// The bone itself, of a right one the left one.
[[nodiscard]] constexpr MmdBone left_of(MmdBone bone) noexcept {
    return side_of(bone) == Side::right ? static_cast<MmdBone>(index_of(bone) - kMmdSideBones)
                                        : bone;
}

/// Bytes that a name of a bone or a morph has in a file; longer ones are cut there.
inline constexpr std::size_t kMmdNameBytes = 15;
/// The same of a bone whose inverse kinematics is switched.
inline constexpr std::size_t kMmdSwitchBytes = 20;

/// The standard name of a bone, in UTF-8.
[[nodiscard]] std::string mmd_name(MmdBone bone);

/// The bone that a name in a file says, in bytes up to its first zero, cut after `field` bytes.
/// Names are compared as bytes, in code page 932 as MikuMikuDance writes them, and as files of
/// others have them, in GBK and UTF-8. Digits and Latin letters may be wide or narrow. None: no
/// bone of a body (hair, a skirt, a helper).
[[nodiscard]] std::optional<MmdBone> mmd_bone_named(std::string_view bytes,
                                                    std::size_t field = kMmdNameBytes);

}  // namespace raks::motion
