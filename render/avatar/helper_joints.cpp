#include "render/avatar/helper_joints.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kShoulderLift = 0.030F;  // metres, by eye

struct LeftHelper {
    std::string_view left_name;
    std::string_view right_name;
    HelperKind kind;
    Bone parent;
    Bone source;
    glm::vec3 roll_axis;
};

constexpr glm::vec3 kAlongArmAxis{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kAlongLegAxis{0.0F, 1.0F, 0.0F};

constexpr std::array kLeftHelpers = {
    LeftHelper{"leftShoulderHalf",
               "rightShoulderHalf",
               HelperKind::half_swing,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftUpperArmTwist",
               "rightUpperArmTwist",
               HelperKind::swing_half_roll,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftElbowHalf",
               "rightElbowHalf",
               HelperKind::half_rotation,
               Bone::left_upper_arm,
               Bone::left_lower_arm,
               kAlongArmAxis},
    LeftHelper{"leftLowerArmTwist",
               "rightLowerArmTwist",
               HelperKind::half_roll,
               Bone::left_lower_arm,
               Bone::left_hand,
               kAlongArmAxis},
    LeftHelper{"leftHipHalf",
               "rightHipHalf",
               HelperKind::half_swing,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftUpperLegTwist",
               "rightUpperLegTwist",
               HelperKind::swing_half_roll,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftKneeHalf",
               "rightKneeHalf",
               HelperKind::half_rotation,
               Bone::left_upper_leg,
               Bone::left_lower_leg,
               kAlongLegAxis},
};
static_assert(2 * kLeftHelpers.size() == kHelperCount);

HelperJoint on_side(const LeftHelper& left,
                    motion::Side side,
                    const motion::Skeleton& skeleton) noexcept {
    HelperJoint helper;
    helper.name = side == motion::Side::left ? left.left_name : left.right_name;
    helper.kind = left.kind;
    helper.parent = motion::on_side(left.parent, side);
    helper.source = motion::on_side(left.source, side);
    helper.roll_axis = left.roll_axis;
    // The forearm's helper turns about the elbow, all others about their source's joint.
    helper.offset = left.kind == HelperKind::half_roll
                        ? glm::vec3{0.0F}
                        : skeleton.offsets[motion::index_of(helper.source)];
    const bool is_shoulder =
        left.kind == HelperKind::half_swing && left.source == Bone::left_upper_arm;
    helper.lift = is_shoulder ? kShoulderLift : 0.0F;
    return helper;
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

std::array<HelperJoint, kHelperCount> mannequin_helpers(const motion::Skeleton& skeleton) noexcept {
    std::array<HelperJoint, kHelperCount> helpers{};
    for (std::size_t i = 0; i < kLeftHelpers.size(); ++i) {
        helpers[i] = on_side(kLeftHelpers[i], motion::Side::left, skeleton);
        helpers[i + kLeftHelpers.size()] = on_side(kLeftHelpers[i], motion::Side::right, skeleton);
    }
    return helpers;
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

}  // namespace raks::render
