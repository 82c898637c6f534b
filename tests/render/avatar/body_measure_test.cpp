// The body of an avatar, as its mesh says.
#include "render/avatar/body_measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/skeleton/body_capsules.hpp"
#include "render/mannequin/mannequin.hpp"

namespace raks::render {
namespace {

using motion::Bone;
using motion::index_of;

/// The mannequin's bones, `size` times as large, standing `lifted` over the floor.
BonePlaces bones_of_size(float size, float lifted = 0.0F) {
    const motion::Skeleton skeleton = motion::scaled(motion::mannequin_skeleton(), size);
    motion::Pose t_pose;
    t_pose.hips_position = skeleton.offsets[0] + glm::vec3(0.0F, lifted, 0.0F);
    BonePlaces bones;
    bones.places = motion::world_pose(skeleton, t_pose).positions;
    bones.is_there.fill(true);
    return bones;
}

/// Points all over the surface of a box that a bone carries.
void add_box(std::vector<FleshPoint>& flesh,
             Bone bone,
             const glm::vec3& low,
             const glm::vec3& high) {
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
            const float u = static_cast<float>(i) / static_cast<float>(kSteps);
            const float v = static_cast<float>(k) / static_cast<float>(kSteps);
            const glm::vec3 size = high - low;
            for (const float w : {0.0F, 1.0F}) {
                flesh.push_back({low + size * glm::vec3(u, v, w), index_of(bone)});
                flesh.push_back({low + size * glm::vec3(u, w, v), index_of(bone)});
                flesh.push_back({low + size * glm::vec3(w, u, v), index_of(bone)});
            }
        }
    }
}

TEST(MeasuredBody, of_the_mannequins_mesh_is_the_one_that_its_dances_were_made_for) {
    const Avatar mannequin = build_mannequin();
    const MeasuredBody body = measure_body(flesh_of(mannequin), bones_of_size(1.0F));
    const motion::Skeleton& known = motion::mannequin_skeleton();
    EXPECT_NEAR(body.soles, 0.0F, 0.006F);
    EXPECT_NEAR(body.height, kMannequinHeight, 0.05F);
    EXPECT_NEAR(body.skeleton.hips_height(), known.hips_height(), 0.006F);
    EXPECT_NEAR(body.skeleton.toe_tip.z, known.toe_tip.z, 0.03F);
    EXPECT_NEAR(body.skeleton.heel.z, known.heel.z, 0.03F);
    EXPECT_NEAR(body.skeleton.ball.y, known.ball.y, 0.006F);
    EXPECT_NEAR(body.skeleton.girth.trunk, known.girth.trunk, 0.03F);
    EXPECT_NEAR(body.skeleton.girth.trunk + body.skeleton.girth.flank,
                known.girth.trunk + known.girth.flank,
                0.03F);
    EXPECT_NEAR(body.skeleton.girth.head, known.girth.head, 0.03F);
    EXPECT_NEAR(body.skeleton.girth.thigh, known.girth.thigh, 0.03F);
    EXPECT_NEAR(body.skeleton.girth.shin, known.girth.shin, 0.02F);
    EXPECT_NEAR(body.skeleton.girth.forearm, known.girth.forearm, 0.015F);
    EXPECT_NEAR(body.skeleton.girth.hand, known.girth.hand, 0.012F);
}

TEST(MeasuredBody, has_the_trunk_head_and_soles_of_its_mesh) {
    const BonePlaces bones = bones_of_size(1.0F, 0.5F);
    std::vector<FleshPoint> flesh;
    add_box(flesh, Bone::spine, {-0.16F, 1.40F, -0.08F}, {0.16F, 1.80F, 0.16F});
    const glm::vec3 head = bones.places[index_of(Bone::head)];
    add_box(
        flesh, Bone::head, head - glm::vec3(0.2F, 0.0F, 0.2F), head + glm::vec3(0.2F, 0.5F, 0.2F));
    for (const Bone foot : {Bone::left_foot, Bone::right_foot}) {
        const float x = bones.places[index_of(foot)].x;
        add_box(flesh, foot, {x - 0.04F, 0.49F, -0.10F}, {x + 0.04F, 0.55F, 0.20F});
    }
    const MeasuredBody body = measure_body(flesh, bones);
    EXPECT_NEAR(body.soles, 0.49F, 1e-5F);
    EXPECT_NEAR(body.height, head.y + 0.5F - 0.49F, 1e-4F);
    EXPECT_NEAR(body.skeleton.hips_height(), 0.94F, 1e-4F);
    const motion::Girth& girth = body.skeleton.girth;
    EXPECT_NEAR(girth.trunk, 0.12F, 0.01F);
    EXPECT_NEAR(girth.trunk + girth.flank, 0.16F, 0.01F);
    EXPECT_NEAR(girth.trunk_ahead, 0.04F, 0.01F);
    EXPECT_NEAR(girth.head, 0.2F, 0.01F);
    EXPECT_NEAR(girth.head_height + girth.head, 0.5F, 0.01F);
    const float ankle = bones.places[index_of(Bone::left_foot)].z;
    EXPECT_NEAR(body.skeleton.toe_tip.z, 0.20F - ankle, 1e-4F);
    EXPECT_NEAR(body.skeleton.heel.z, -0.10F - ankle, 1e-4F);
    EXPECT_NEAR(body.skeleton.ball.y, 0.49F - bones.places[index_of(Bone::left_foot)].y, 1e-4F);
}

TEST(MeasuredBody, without_a_mesh_is_the_mannequin_as_large_as_its_hips_say) {
    const MeasuredBody body = measure_body({}, bones_of_size(0.6F));
    const motion::Skeleton known = motion::scaled(motion::mannequin_skeleton(), 0.6F);
    EXPECT_NEAR(body.skeleton.hips_height(), known.hips_height(), 1e-5F);
    EXPECT_NEAR(body.skeleton.girth.trunk, known.girth.trunk, 1e-5F);
    EXPECT_NEAR(body.skeleton.girth.hand, known.girth.hand, 1e-5F);
    EXPECT_NEAR(body.skeleton.toe_tip.z, known.toe_tip.z, 1e-5F);
}

TEST(MeasuredBody, that_lacks_toes_and_fingers_can_be_danced_on) {
    BonePlaces bones = bones_of_size(1.0F);
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        const auto bone = static_cast<Bone>(b);
        const Bone left = std::min(bone, motion::mirrored(bone));
        if (left == Bone::left_toes || left >= Bone::left_thumb_metacarpal) {
            bones.is_there[b] = false;
            bones.places[b] = bones.places[motion::kBoneParents[b]];
        }
    }
    const motion::Skeleton skeleton = measure_body({}, bones).skeleton;
    EXPECT_NEAR(skeleton.offsets[index_of(Bone::left_middle_proximal)].x, 0.09F, 1e-4F);
    EXPECT_NEAR(skeleton.offsets[index_of(Bone::right_middle_proximal)].x, -0.09F, 1e-4F);
    // The whole foot is stiff: it turns about its tip.
    EXPECT_NEAR(skeleton.offsets[index_of(Bone::left_toes)].z, skeleton.ball.z, 1e-5F);
    EXPECT_LT(skeleton.toe_tip.z - skeleton.ball.z, 0.02F);
    EXPECT_GT(skeleton.toe_tip.z, skeleton.ball.z);
    EXPECT_FLOAT_EQ(skeleton.offsets[index_of(Bone::right_toes)].x,
                    -skeleton.offsets[index_of(Bone::left_toes)].x);
}

TEST(MeasuredBody, of_a_broken_mesh_stays_one_that_a_body_can_have) {
    std::vector<FleshPoint> flesh;
    add_box(flesh, Bone::spine, {-90.0F, 0.0F, -90.0F}, {90.0F, 2.0F, 90.0F});
    add_box(flesh, Bone::head, {-90.0F, 1.0F, -90.0F}, {90.0F, 90.0F, 90.0F});
    add_box(flesh, Bone::left_hand, {0.0F, -90.0F, 0.0F}, {1.0F, 90.0F, 1.0F});
    const motion::Girth girth = measure_body(flesh, bones_of_size(1.0F)).skeleton.girth;
    const motion::Girth usual;
    for (const auto& [is, known] : {std::pair(girth.trunk + girth.flank, usual.trunk + usual.flank),
                                    std::pair(girth.head, usual.head),
                                    std::pair(girth.hand, usual.hand)}) {
        EXPECT_LE(is, 8.0F * known + 1e-4F);
        EXPECT_GE(is, 0.5F * known - 1e-4F);
    }
}

TEST(DanceBody, of_short_legs_under_a_high_joint_stands_on_legs_as_long_as_the_mannequins) {
    BonePlaces bones = bones_of_size(1.0F);
    bones.places[index_of(Bone::hips)].y += 0.5F;
    const MeasuredBody measured = measure_body({}, bones);
    EXPECT_NEAR(measured.pelvis_drop, 0.5F, 1e-4F);
    Avatar avatar;
    avatar.skeleton = measured.skeleton;
    avatar.pelvis_drop = measured.pelvis_drop;
    const motion::Skeleton body = dance_body(avatar);
    const motion::Skeleton& known = motion::mannequin_skeleton();
    EXPECT_NEAR(body.hips_height(), known.hips_height(), 1e-5F);
    EXPECT_NEAR(body.offsets[index_of(Bone::left_upper_leg)].y,
                known.offsets[index_of(Bone::left_upper_leg)].y,
                1e-4F);
    // A pose of that body and the same pose on the avatar: all joints are at the same places.
    motion::Pose pose;
    pose.hips_position = {0.3F, 0.8F, -0.2F};
    pose.rotation(Bone::hips) = glm::angleAxis(0.4F, glm::normalize(glm::vec3(1, 2, 3)));
    const motion::Pose own = retargeted(pose, body, avatar);
    const motion::WorldPose solved = motion::world_pose(body, pose);
    const motion::WorldPose worn = motion::world_pose(avatar.skeleton, own);
    for (std::size_t i = 1; i < motion::kBoneCount; ++i) {
        EXPECT_LT(glm::distance(solved.positions[i], worn.positions[i]), 1e-4F) << i;
    }
}

TEST(DanceBody, of_the_mannequin_is_its_own_to_the_bit_and_of_another_as_large) {
    Avatar avatar;
    avatar.skeleton = motion::mannequin_skeleton();
    EXPECT_EQ(dance_body(avatar), motion::mannequin_skeleton());
    avatar.skeleton = motion::scaled(avatar.skeleton, 0.37F);
    EXPECT_NEAR(
        dance_body(avatar).hips_height(), motion::mannequin_skeleton().hips_height(), 1e-6F);
    EXPECT_NEAR(dance_body(avatar).girth.trunk, motion::Girth().trunk, 1e-6F);
}

}  // namespace
}  // namespace raks::render
