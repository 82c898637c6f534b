#include "render/mannequin/bind_pose.hpp"

namespace raks::render {
namespace {

using motion::Bone;

struct BoneRotation {
    Bone bone;
    glm::quat rotation;  // w, x, y, z
};

// Left side; the right one is its mirror. Upper arm 40 degrees down, collar bone 4, elbow 12, thigh
// 6 outwards, knee 6, sole on the floor, fingers spread by 4 to 7 and bent by 5 to 11.
constexpr std::array kLeftBindRotations = {
    BoneRotation{Bone::left_upper_leg, {0.99863F, 0.0F, 0.0F, 0.05234F}},
    BoneRotation{Bone::left_lower_leg, {0.99863F, 0.05234F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_foot, {0.99726F, -0.05226F, 0.00274F, -0.05226F}},
    BoneRotation{Bone::left_shoulder, {0.99939F, 0.0F, 0.0F, -0.0349F}},
    BoneRotation{Bone::left_upper_arm, {0.93969F, 0.0F, 0.0F, -0.34202F}},
    BoneRotation{Bone::left_lower_arm, {0.99452F, 0.0F, -0.10453F, 0.0F}},
    BoneRotation{Bone::left_index_proximal, {0.99802F, 0.00183F, -0.03485F, -0.0523F}},
    BoneRotation{Bone::left_index_intermediate, {0.99756F, 0.0F, 0.0F, -0.06976F}},
    BoneRotation{Bone::left_index_distal, {0.99905F, 0.0F, 0.0F, -0.04362F}},
    BoneRotation{Bone::left_middle_proximal, {0.99813F, 0.0F, 0.0F, -0.06105F}},
    BoneRotation{Bone::left_middle_intermediate, {0.99692F, 0.0F, 0.0F, -0.07846F}},
    BoneRotation{Bone::left_middle_distal, {0.99863F, 0.0F, 0.0F, -0.05234F}},
    BoneRotation{Bone::left_ring_proximal, {0.99696F, -0.00243F, 0.03481F, -0.06971F}},
    BoneRotation{Bone::left_ring_intermediate, {0.99619F, 0.0F, 0.0F, -0.08716F}},
    BoneRotation{Bone::left_ring_distal, {0.99863F, 0.0F, 0.0F, -0.05234F}},
    BoneRotation{Bone::left_little_proximal, {0.99506F, -0.00479F, 0.06086F, -0.07831F}},
    BoneRotation{Bone::left_little_intermediate, {0.9954F, 0.0F, 0.0F, -0.09585F}},
    BoneRotation{Bone::left_little_distal, {0.99813F, 0.0F, 0.0F, -0.06105F}},
};

motion::WorldPose world_of(const motion::Skeleton& skeleton, motion::Pose pose) noexcept {
    pose.hips_position = skeleton.offsets[0];
    return motion::world_pose(skeleton, pose);
}

}  // namespace

motion::Pose mannequin_bind_pose() noexcept {
    motion::Pose pose;
    for (const BoneRotation& left : kLeftBindRotations) {
        const glm::quat rotation = glm::normalize(left.rotation);
        pose.rotation(left.bone) = rotation;
        pose.rotation(motion::mirrored(left.bone)) =
            glm::quat(rotation.w, rotation.x, -rotation.y, -rotation.z);
    }
    pose.hips_position = motion::mannequin_skeleton().offsets[0];
    return pose;
}

BindFrames::BindFrames(const motion::Skeleton& skeleton, const motion::Pose& bind_pose) noexcept
    : rest_(world_of(skeleton, motion::Pose{})), bind_(world_of(skeleton, bind_pose)) {}

}  // namespace raks::render
