#include "render/avatar/avatar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;

/// Rise of the collar bone that an arm `elevation` over the horizontal asks for (scapulohumeral
/// rhythm): 30 degrees when it points straight up, with a soft start. Radians.
float wanted_rise(float elevation) noexcept {
    constexpr float kShare = 0.40F;
    constexpr float kSoftStart = glm::radians(30.0F);
    if (elevation <= 0.0F) {
        return 0.0F;
    }
    const float beyond = elevation < kSoftStart ? elevation * elevation / (2.0F * kSoftStart)
                                                : elevation - 0.5F * kSoftStart;
    return kShare * beyond;
}

/// Angle of a unit direction over the horizontal plane of its frame.
float elevation_of(glm::vec3 direction) noexcept {
    return std::asin(std::clamp(direction.y, -1.0F, 1.0F));
}

void raise_collar_bone(motion::Side side, motion::Pose& pose) noexcept {
    const float outward = side == motion::Side::left ? 1.0F : -1.0F;
    const glm::vec3 along_bone{outward, 0.0F, 0.0F};
    glm::quat& shoulder = pose.rotation(motion::on_side(Bone::left_shoulder, side));
    glm::quat& upper_arm = pose.rotation(motion::on_side(Bone::left_upper_arm, side));

    const glm::quat chest_from_arm = shoulder * upper_arm;
    const float own_rise = std::max(elevation_of(shoulder * along_bone), 0.0F);
    const float missing = wanted_rise(elevation_of(chest_from_arm * along_bone)) - own_rise;
    if (missing <= 0.0F) {
        return;
    }
    const float half = 0.5F * outward * missing;
    shoulder = glm::quat(std::cos(half), 0.0F, 0.0F, std::sin(half)) * shoulder;
    upper_arm = glm::conjugate(shoulder) * chest_from_arm;
}

/// The turn of q about a unit axis. Undefined at a swing of 180 degrees: there it fades to none.
glm::quat roll_of(const glm::quat& q, glm::vec3 axis) noexcept {
    constexpr float kFadeBelow = 0.15F;  // cosine of half the swing: 163 degrees
    const float along = glm::dot(glm::vec3{q.x, q.y, q.z}, axis);
    const float length = std::sqrt(q.w * q.w + along * along);
    const float fade = std::copysign(std::max(kFadeBelow - length, 0.0F), q.w);
    return glm::normalize(glm::quat(q.w + fade, axis.x * along, axis.y * along, axis.z * along));
}

/// Half of a rotation by the shorter way.
glm::quat half_of(const glm::quat& q) noexcept {
    const float sign = q.w < 0.0F ? -1.0F : 1.0F;
    return glm::normalize(glm::quat(1.0F + sign * q.w, sign * q.x, sign * q.y, sign * q.z));
}

/// Up in the parent's frame; grows with the square of the sine of the source's elevation.
glm::vec3 lift_of(const HelperJoint& helper, const glm::quat& source) noexcept {
    const float outward =
        motion::index_of(helper.source) < motion::index_of(motion::Bone::right_upper_leg) ? 1.0F
                                                                                          : -1.0F;
    const float sine = std::max((source * (outward * helper.roll_axis)).y, 0.0F);
    return {0.0F, helper.lift * sine * sine, 0.0F};
}

glm::mat4 matrix_of(const glm::quat& rotation, glm::vec3 position) noexcept {
    glm::mat4 matrix = glm::mat4_cast(rotation);
    matrix[3] = glm::vec4(position, 1.0F);
    return matrix;
}

}  // namespace

float size_of(const Avatar& avatar) noexcept { return avatar.height / kMannequinHeight; }

motion::Skeleton dance_body(const Avatar& avatar) noexcept {
    motion::Skeleton body = avatar.skeleton;
    const glm::vec3 drop(0.0F, avatar.pelvis_drop, 0.0F);
    body.offsets[motion::index_of(Bone::hips)] -= drop;
    for (const Bone bone : {Bone::spine, Bone::left_upper_leg, Bone::right_upper_leg}) {
        body.offsets[motion::index_of(bone)] += drop;
    }
    const float size = motion::mannequin_skeleton().hips_height() / body.hips_height();
    body.shown_size = 1.0F / size;
    return motion::scaled(body, size);
}

motion::Pose retargeted(motion::Pose pose,
                        const motion::Skeleton& made_for,
                        const motion::Skeleton& skeleton,
                        float pelvis_drop) noexcept {
    const float size = (skeleton.hips_height() - pelvis_drop) / made_for.hips_height();
    pose.hips_position =
        size * pose.hips_position + pose.rotation(Bone::hips) * glm::vec3(0.0F, pelvis_drop, 0.0F);
    return pose;
}

glm::quat helper_rotation(const HelperJoint& helper, const glm::quat& source) noexcept {
    if (helper.kind == HelperKind::half_rotation) {
        return half_of(source);
    }
    const glm::quat roll = roll_of(source, helper.roll_axis);
    if (helper.kind == HelperKind::half_roll) {
        return half_of(roll);
    }
    const glm::quat swing = source * glm::conjugate(roll);
    return helper.kind == HelperKind::half_swing ? half_of(swing) : swing * half_of(roll);
}

void joint_matrices(const Avatar& avatar,
                    const motion::Pose& pose,
                    std::span<glm::mat4, kPaletteSize> world_from_joint) noexcept {
    const motion::WorldPose world = motion::world_pose(avatar.skeleton, pose);
    for (std::size_t i = 0; i < motion::kBoneParents.size(); ++i) {
        world_from_joint[i] = matrix_of(world.rotations[i], world.positions[i]);
    }
    for (std::size_t i = 0; i < avatar.helpers.size(); ++i) {
        const HelperJoint& helper = avatar.helpers[i];
        const glm::quat& source = pose.rotation(helper.source);
        const glm::quat rotation = world.rotation(helper.parent) * helper_rotation(helper, source);
        world_from_joint[motion::kBoneParents.size() + i] = matrix_of(
            rotation, world.point(helper.parent, helper.offset + lift_of(helper, source)));
    }
}

motion::Pose with_shoulder_rhythm(const motion::Pose& pose) noexcept {
    motion::Pose risen = pose;
    for (const motion::Side side : motion::kSides) {
        raise_collar_bone(side, risen);
    }
    return risen;
}

void skinning_palette(const Avatar& avatar,
                      const motion::Pose& pose,
                      std::span<glm::mat4, kPaletteSize> palette) noexcept {
    joint_matrices(avatar, with_shoulder_rhythm(pose), palette);
    for (std::size_t i = 0; i < palette.size(); ++i) {
        palette[i] = palette[i] * avatar.inverse_bind[i];
    }
}

}  // namespace raks::render
