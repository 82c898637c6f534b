#pragma once

#include <array>
#include <span>
#include <type_traits>

#include "base/realtime.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

/// Pose: a posture of the humanoid. Axes, here and wherever something moves or is drawn:
/// right-handed, metres, y up, the figure faces +z, its left is +x. Quaternions are unit; glm's
/// constructor takes (w, x, y, z).
namespace raks::motion {

inline constexpr glm::quat kNoRotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< the identity

/// One posture of the humanoid: local rotations relative to the T-pose (identity everywhere is the
/// T-pose, palms down), the place of the hips, and the feet in contact.
struct Pose {
    std::array<glm::quat, kBoneCount> local_rotations = all_identity();  ///< by bone
    glm::vec3 hips_position{0.0F, 0.0F, 0.0F};                           ///< world; metres
    std::array<bool, 2> foot_contact{};  ///< by Side: toe or sole planted

    /// Local rotation of a bone.
    [[nodiscard]] glm::quat& rotation(Bone bone) noexcept {
        return local_rotations[index_of(bone)];
    }
    /// Local rotation of a bone.
    [[nodiscard]] const glm::quat& rotation(Bone bone) const noexcept {
        return local_rotations[index_of(bone)];
    }

 private:
    static constexpr std::array<glm::quat, kBoneCount> all_identity() noexcept {
        std::array<glm::quat, kBoneCount> rotations{};
        for (glm::quat& rotation : rotations) {
            rotation = kNoRotation;
        }
        return rotations;
    }
};
static_assert(std::is_trivially_copyable_v<Pose>);

/// Interpolates two rotations along the shorter arc (normalised linear); `t` in [0, 1]. Threads:
/// any. Real-time: yes.
[[nodiscard]] glm::quat interpolate(const glm::quat& from,
                                    const glm::quat& to,
                                    float t) noexcept RAKS_NONBLOCKING;

/// Interpolates two poses: rotations along the shorter arc (normalised linear), position linear,
/// contacts those of the nearer pose; `t` in [0, 1]. Threads: any. Real-time: yes.
[[nodiscard]] Pose interpolate(const Pose& from, const Pose& to, float t) noexcept RAKS_NONBLOCKING;

/// The pose at a fractional index of `poses` (at least one), held before the first and behind the
/// last. Threads: any. Real-time: yes.
[[nodiscard]] Pose pose_between(std::span<const Pose> poses,
                                double index) noexcept RAKS_NONBLOCKING;

/// The mirror image (plane x = 0): left and right exchanged. Threads: any. Real-time: yes.
[[nodiscard]] Pose mirrored(const Pose& pose) noexcept;

/// Whether all numbers of a pose are finite. Threads: any. Real-time: yes.
[[nodiscard]] bool is_finite(const Pose& pose) noexcept;

// Hand shape: fingers from open to closed.

/// Sets the fingers of a hand, from open and flat (`fist` 0) to a fist with the thumb beside it
/// (1).
void set_hand_shape(Side side, double fist, Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
