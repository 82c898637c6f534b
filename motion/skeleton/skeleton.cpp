#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

// Metres from the parent's joint, in the order of Bone.
constexpr std::array<glm::vec3, kBoneCount> kMannequinOffsets = {{
    {0.0F, 0.93F, 0.0F},               // hips
    {0.0F, 0.085F, -0.008F},           // spine
    {0.0F, 0.1F, -0.01F},              // chest
    {0.0F, 0.115F, -0.006F},           // upperChest
    {0.0F, 0.175F, -0.006F},           // neck
    {0.0F, 0.085F, 0.018F},            // head
    {0.088F, -0.038F, 0.0F},           // leftUpperLeg
    {-0.004F, -0.406F, 0.006F},        // leftLowerLeg
    {-0.002F, -0.408F, -0.028F},       // leftFoot
    {0.002F, -0.056F, 0.125F},         // leftToes
    {0.022F, 0.138F, 0.024F},          // leftShoulder
    {0.136F, -0.006F, -0.024F},        // leftUpperArm
    {0.275F, 0.0F, -0.002F},           // leftLowerArm
    {0.239F, 0.0F, 0.002F},            // leftHand
    {0.022F, -0.008F, 0.02F},          // leftThumbMetacarpal
    {0.03339F, -0.00988F, 0.03006F},   // leftThumbProximal
    {0.02701F, -0.00521F, 0.01822F},   // leftThumbDistal
    {0.087F, 0.0F, 0.0255F},           // leftIndexProximal
    {0.0409F, 0.0F, 0.00286F},         // leftIndexIntermediate
    {0.02494F, 0.0F, 0.00174F},        // leftIndexDistal
    {0.09F, 0.0015F, 0.0045F},         // leftMiddleProximal
    {0.04499F, 0.0F, 0.00079F},        // leftMiddleIntermediate
    {0.029F, 0.0F, 0.00051F},          // leftMiddleDistal
    {0.086F, 0.0F, -0.016F},           // leftRingProximal
    {0.04098F, 0.0F, -0.00143F},       // leftRingIntermediate
    {0.02698F, 0.0F, -0.00094F},       // leftRingDistal
    {0.078F, -0.003F, -0.0345F},       // leftLittleProximal
    {0.03182F, 0.0F, -0.00334F},       // leftLittleIntermediate
    {0.01989F, 0.0F, -0.00209F},       // leftLittleDistal
    {-0.088F, -0.038F, 0.0F},          // rightUpperLeg
    {0.004F, -0.406F, 0.006F},         // rightLowerLeg
    {0.002F, -0.408F, -0.028F},        // rightFoot
    {-0.002F, -0.056F, 0.125F},        // rightToes
    {-0.022F, 0.138F, 0.024F},         // rightShoulder
    {-0.136F, -0.006F, -0.024F},       // rightUpperArm
    {-0.275F, 0.0F, -0.002F},          // rightLowerArm
    {-0.239F, 0.0F, 0.002F},           // rightHand
    {-0.022F, -0.008F, 0.02F},         // rightThumbMetacarpal
    {-0.03339F, -0.00988F, 0.03006F},  // rightThumbProximal
    {-0.02701F, -0.00521F, 0.01822F},  // rightThumbDistal
    {-0.087F, 0.0F, 0.0255F},          // rightIndexProximal
    {-0.0409F, 0.0F, 0.00286F},        // rightIndexIntermediate
    {-0.02494F, 0.0F, 0.00174F},       // rightIndexDistal
    {-0.09F, 0.0015F, 0.0045F},        // rightMiddleProximal
    {-0.04499F, 0.0F, 0.00079F},       // rightMiddleIntermediate
    {-0.029F, 0.0F, 0.00051F},         // rightMiddleDistal
    {-0.086F, 0.0F, -0.016F},          // rightRingProximal
    {-0.04098F, 0.0F, -0.00143F},      // rightRingIntermediate
    {-0.02698F, 0.0F, -0.00094F},      // rightRingDistal
    {-0.078F, -0.003F, -0.0345F},      // rightLittleProximal
    {-0.03182F, 0.0F, -0.00334F},      // rightLittleIntermediate
    {-0.01989F, 0.0F, -0.00209F},      // rightLittleDistal
}};

Skeleton make_mannequin_skeleton() noexcept {
    Skeleton skeleton;
    skeleton.offsets = kMannequinOffsets;
    const float sole = -0.078F;  // the ankle stands 78 mm over the floor
    skeleton.ball = {0.002F, sole, 0.125F};
    skeleton.toe_tip = {0.004F, sole, 0.190F};
    skeleton.heel = {0.0F, sole, -0.050F};
    skeleton.sole_half = 0.030F;
    return skeleton;
}

}  // namespace

const Skeleton& mannequin_skeleton() noexcept {
    static const Skeleton skeleton = make_mannequin_skeleton();
    return skeleton;
}

Skeleton scaled(Skeleton skeleton, float factor) noexcept {
    for (glm::vec3& offset : skeleton.offsets) {
        offset *= factor;
    }
    for (glm::vec3* point : {&skeleton.ball, &skeleton.toe_tip, &skeleton.heel}) {
        *point *= factor;
    }
    skeleton.sole_half *= factor;
    Girth& girth = skeleton.girth;
    for (float* length : {&girth.flank,
                          &girth.trunk,
                          &girth.trunk_ahead,
                          &girth.chest_height,
                          &girth.head,
                          &girth.head_height,
                          &girth.thigh,
                          &girth.shin,
                          &girth.forearm,
                          &girth.hand}) {
        *length *= factor;
    }
    return skeleton;
}

namespace {

/// Places the bones from `first` to `last`, whose parents outside of this range are placed.
void place_bones(const Skeleton& skeleton,
                 const Pose& pose,
                 Bone first,
                 Bone last,
                 WorldPose& world) noexcept RAKS_NONBLOCKING {
    // Parents come before their children, so one pass suffices.
    for (std::size_t i = index_of(first); i <= index_of(last); ++i) {
        const std::size_t parent = kBoneParents[i];
        world.positions[i] =
            world.positions[parent] + world.rotations[parent] * skeleton.offsets[i];
        world.rotations[i] = world.rotations[parent] * pose.local_rotations[i];
    }
}

WorldPose placed_hips(const Pose& pose) noexcept RAKS_NONBLOCKING {
    WorldPose world;
    world.positions[0] = pose.hips_position;
    world.rotations[0] = pose.local_rotations[0];
    return world;
}

}  // namespace

WorldPose world_pose(const Skeleton& skeleton, const Pose& pose) noexcept RAKS_NONBLOCKING {
    WorldPose world = placed_hips(pose);
    place_bones(skeleton, pose, Bone::spine, Bone::right_little_distal, world);
    return world;
}

WorldPose world_body(const Skeleton& skeleton, const Pose& pose) noexcept RAKS_NONBLOCKING {
    WorldPose world = placed_hips(pose);
    place_bones(skeleton, pose, Bone::spine, Bone::left_hand, world);
    place_bones(skeleton, pose, Bone::left_middle_proximal, Bone::left_middle_intermediate, world);
    place_bones(skeleton, pose, Bone::right_upper_leg, Bone::right_hand, world);
    place_bones(
        skeleton, pose, Bone::right_middle_proximal, Bone::right_middle_intermediate, world);
    return world;
}

glm::vec3 foot_point(const WorldPose& world,
                     Side side,
                     glm::vec3 left_local) noexcept RAKS_NONBLOCKING {
    if (side == Side::right) {
        left_local.x = -left_local.x;
    }
    return world.point(on_side(Bone::left_foot, side), left_local);
}

glm::vec3 toe_tip(const Skeleton& skeleton,
                  const WorldPose& world,
                  Side side) noexcept RAKS_NONBLOCKING {
    // From the toes' own joint: they bend at the ball.
    glm::vec3 from_joint = skeleton.toe_tip - skeleton.offsets[index_of(Bone::left_toes)];
    if (side == Side::right) {
        from_joint.x = -from_joint.x;
    }
    return world.point(on_side(Bone::left_toes, side), from_joint);
}

}  // namespace raks::motion
