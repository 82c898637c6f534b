#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/avatar/avatar.hpp"
#include "render/avatar/helper_joints.hpp"

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

}  // namespace

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
