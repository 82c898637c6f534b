#pragma once

#include <array>
#include <type_traits>

#include "motion/skeleton/humanoid.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

/// Axes, here and in every room that draws or moves: right-handed, metres, y up, the figure faces
/// +z, its left is +x. Quaternions are unit; glm's constructor takes (w, x, y, z).
namespace raks::motion {

inline constexpr glm::quat kNoRotation{1.0F, 0.0F, 0.0F, 0.0F};

/// One posture of the humanoid: local rotations against the T-pose (identity everywhere is the
/// T-pose, palms down), the place of the hips, and what stands on the floor.
struct Pose {
    std::array<glm::quat, kBoneCount> local_rotations = all_identity();
    glm::vec3 hips_position{0.0F, 0.0F, 0.0F};  ///< world; metres
    std::array<bool, 2> foot_contact{};         ///< by Side: toe or sole planted

    [[nodiscard]] glm::quat& rotation(Bone bone) noexcept {
        return local_rotations[index_of(bone)];
    }
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

/// Between two rotations along the shorter arc (normalized linear), `t` in [0, 1].
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat interpolate(const glm::quat& from, const glm::quat& to, float t) noexcept;

/// Between two poses: rotations along the shorter arc (normalized linear), position linear,
/// contacts those of the nearer pose. `t` in [0, 1].
/// Threads: any. Real-time: yes.
[[nodiscard]] Pose interpolate(const Pose& from, const Pose& to, float t) noexcept;

/// Left and right exchanged (mirror plane x = 0).
/// Threads: any. Real-time: yes.
[[nodiscard]] Pose mirrored(const Pose& pose) noexcept;

}  // namespace raks::motion
