#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/surface.hpp"
#include "render/model/character.hpp"
#include "render/model/mannequin_style.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

/// A drawable body: one skinned mesh, the joints that move it, and from a pose to the matrices that
/// move its vertices. Metres, y up, facing +z, the
/// figure's left is +x. OpenGL stays out of this header: the arrays below are uploaded as they are.
namespace raks::render {

/// Joints that are no bones: they lie between a bone and its parent and take a part of the bone's
/// rotation, so that linear blend skinning keeps the volume of shoulders, hips, elbows, wrists.
inline constexpr int kHelperCount = 14;
/// Matrices of a skinning palette: the 52 bones in the order of motion::Bone, then the helpers.
inline constexpr int kPaletteSize = motion::kBoneCount + kHelperCount;

/// Colour areas of a vertex: signed distances to the area's edge, positive inside, 127 = 0.04 m.
/// Interpolated over the triangle and cut in the fragment shader by
/// `clamp(d / fwidth(d) + 0.5, 0, 1)`, edges stay sharp on a coarse mesh without a texture.
enum class AvatarMask : std::uint8_t {
    suit,    ///< unitard; along its edge, where |suit| is small, runs the trim (piping)
    stripe,  ///< signed distance to the middle of the side stripe: drawn where |stripe| < 0.2,
             ///< inside the suit and where outer > 0
    outer,   ///< outer side of trunk and limb
    hair,    ///< skin under the hair
    shoe,    ///< dance shoe
    accent,  ///< sole and heel of the shoe
    band,    ///< joint bands of the plain mannequin: neck, waist, elbow, wrist, knee, ankle
};
inline constexpr int kMaskCount = 7;
inline constexpr std::array<std::string_view, kMaskCount> kMaskNames = {
    "suit",
    "stripe",
    "outer",
    "hair",
    "shoe",
    "accent",
    "band",
};
inline constexpr float kMaskRange = 0.04F;  ///< metres that are 127 in a mask byte

/// One vertex as uploaded, in the bind pose; 36 bytes, no padding.
///
///     offset  type        OpenGL attribute                      is
///     0       float[3]    3 GL_FLOAT                            position, metres
///     12      int16[4]    4 GL_SHORT, normalized                unit normal; w = 0
///     20      uint8[4]    4 GL_UNSIGNED_BYTE, integer           palette indices, 0..65
///     24      uint8[4]    4 GL_UNSIGNED_BYTE, normalized        weights, sum exactly 255
///     28      int8[7]     4 + 3 GL_BYTE, normalized             masks by AvatarMask (28: suit,
///                                                               stripe, outer, hair; 32: shoe,
///                                                               accent, band)
///     35      uint8       1 GL_UNSIGNED_BYTE, normalized        ambient occlusion, 255 = open
struct AvatarVertex {
    std::array<float, 3> position{};
    std::array<std::int16_t, 4> normal{};
    std::array<std::uint8_t, 4> joints{};
    std::array<std::uint8_t, 4> weights{};
    std::array<std::int8_t, kMaskCount> masks{};
    std::uint8_t ambient_occlusion = 255;
};
static_assert(sizeof(AvatarVertex) == 36 && std::is_trivially_copyable_v<AvatarVertex>);
static_assert(offsetof(AvatarVertex, normal) == 12 && offsetof(AvatarVertex, joints) == 20);
static_assert(offsetof(AvatarVertex, weights) == 24 && offsetof(AvatarVertex, masks) == 28);
static_assert(offsetof(AvatarVertex, ambient_occlusion) == 35);

/// What a helper joint takes of its source bone's rotation q = swing * roll, where roll turns about
/// the helper's roll axis.
enum class HelperKind : std::uint8_t {
    half_swing,       ///< half of the swing, no roll: armpit, groin, buttock
    swing_half_roll,  ///< all of the swing, half of the roll: limbs rolled in shoulder and hip
    half_rotation,    ///< half of q: elbow, knee
    half_roll,        ///< half of the roll alone: forearm, of the hand's roll
};

struct HelperJoint {
    std::string_view name;  ///< "leftElbowHalf"
    HelperKind kind = HelperKind::half_rotation;
    motion::Bone parent = motion::Bone::hips;
    motion::Bone source = motion::Bone::hips;
    glm::vec3 roll_axis{};  ///< unit, in the source's frame
    glm::vec3 offset{};     ///< from the parent's joint, in the parent's frame
    /// Metres by which the joint is lifted when its source points straight up: the shoulder muscle
    /// bunches beside the neck. Nothing at or below the horizontal.
    float lift = 0.0F;
};

/// Height of the mannequin's mesh in its T-pose; metres.
inline constexpr float kMannequinHeight = 1.714F;

/// Immutable once built. Its body is a painted skin (the mannequin), a textured surface (from a
/// file), or both.
struct Avatar {
    std::string name;
    motion::Skeleton skeleton;  ///< with girth and soles: what its dances are solved for
    /// From the floor to the top of the mesh, with hair and hat, in the T-pose; metres.
    float height = kMannequinHeight;

    /// How far below the hips' joint the pelvis is that dances move: as far over the legs' joints,
    /// by their height, as the mannequin's hips. Figures with short legs have their joint in the
    /// belly; steps go by the legs. Metres, may be negative.
    float pelvis_drop = 0.0F;

    // A surface and what moves it; none: `rig` is null.
    Surface surface;
    std::shared_ptr<const AvatarRig> rig;
    float soles = 0.0F;                 ///< height of the soles in the rig's T-pose; metres
    VrmVersion vrm = VrmVersion::none;  ///< of the file that the rig is from

    // A painted skin and the bones and helpers that move it.
    motion::Pose bind_pose;  ///< an A-pose: the posture in which vertices and normals are given
    std::vector<AvatarVertex> vertices;  ///< fewer than 65,536
    std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise seen from outside
    std::array<glm::mat4, kPaletteSize> inverse_bind{};  ///< joint from world, in the bind pose
    std::array<HelperJoint, kHelperCount> helpers{};
    std::string licence;   ///< SPDX identifier
    MannequinStyle style;  ///< says how an outfit colours the skin and what is worn over it
};

/// Its size against the mannequin's, for cameras and shadows: the ratio of the heights of the
/// meshes, 1 for the mannequin. A figure with a large head is larger than its legs tell.
[[nodiscard]] float size_of(const Avatar& avatar) noexcept;

/// The body that dances are solved for: the avatar's from its pelvis on, as large as the mannequin
/// by the height of that. So all that is measured in metres (how far two stand apart, a step aside)
/// suits it, and its poses are the avatar's own by retargeted(). The mannequin's is its skeleton.
[[nodiscard]] motion::Skeleton dance_body(const Avatar& avatar) noexcept;

/// A pose that was made for another body, on one with this skeleton: the pelvis' place by the ratio
/// of their heights. Threads: any. Real-time: yes.
[[nodiscard]] motion::Pose retargeted(motion::Pose pose,
                                      const motion::Skeleton& made_for,
                                      const motion::Skeleton& skeleton,
                                      float pelvis_drop) noexcept;
/// The same on an avatar.
[[nodiscard]] inline motion::Pose retargeted(const motion::Pose& pose,
                                             const motion::Skeleton& made_for,
                                             const Avatar& avatar) noexcept {
    return retargeted(pose, made_for, avatar.skeleton, avatar.pelvis_drop);
}

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
