#pragma once

#include <span>

#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

/// From a pose to the matrices that move an avatar's vertices.
namespace raks::render {

/// Rotation of a helper against its parent, from the local rotation of its source bone.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::quat helper_rotation(const HelperJoint& helper,
                                        const glm::quat& source) noexcept;

/// Place and orientation of all 66 joints in the world, as matrices.
/// Threads: any. Real-time: yes.
void joint_matrices(const Avatar& avatar,
                    const motion::Pose& pose,
                    std::span<glm::mat4, kPaletteSize> world_from_joint) noexcept;

/// The pose as the body shows it: collar bones rise with raised arms (scapulohumeral rhythm) where
/// the pose does not say so itself; the arm keeps its direction in the world. The identity for arms
/// below the horizontal. `skinning_palette` applies it; a stick figure should, too.
/// Threads: any. Real-time: yes.
[[nodiscard]] motion::Pose with_shoulder_rhythm(const motion::Pose& pose) noexcept;

/// Skinning matrices of one pose, `world_from_bind`: a vertex goes to
/// `sum_i weights[i] / 255 * palette[joints[i]] * vec4(position, 1)`.
/// Identity matrices for the avatar's bind pose. The hips are placed at `pose.hips_position`.
/// Threads: any. Real-time: yes (no allocation).
void skinning_palette(const Avatar& avatar,
                      const motion::Pose& pose,
                      std::span<glm::mat4, kPaletteSize> palette) noexcept;

}  // namespace raks::render
