#include <algorithm>
#include <cmath>

#include "render/avatar/avatar.hpp"
#include "render/mannequin/skin_weights.hpp"
#include "render/mannequin/test_poses.hpp"
#include "tests/render/avatar/posed_mesh.hpp"
#include "tests/support/realtime_guard.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render::test {
namespace {

using motion::Bone;
using motion::Pose;
using motion::Side;

constexpr glm::vec3 kX{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kZ{0.0F, 0.0F, 1.0F};

glm::quat turn(float degrees, glm::vec3 axis) {
    return glm::angleAxis(glm::radians(degrees), axis);
}

float angle_between(const glm::quat& a, const glm::quat& b) {
    return glm::degrees(2.0F * std::acos(std::min(std::abs(glm::dot(a, b)), 1.0F)));
}

/// Both arms `elevation` degrees over the horizontal, collar bones at rest.
Pose arms_at(float elevation) {
    Pose pose;
    pose.rotation(Bone::left_upper_arm) = turn(elevation, kZ);
    pose.rotation(Bone::right_upper_arm) = turn(-elevation, kZ);
    return pose;
}

float collar_rise(const Pose& pose) {
    return glm::degrees(std::asin((pose.rotation(Bone::left_shoulder) * kX).y));
}

TEST(Palette, is_the_identity_in_the_bind_pose) {
    std::array<glm::mat4, kPaletteSize> palette{};
    skinning_palette(mannequin(), mannequin().bind_pose, palette);
    for (std::size_t joint = 0; joint < palette.size(); ++joint) {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                EXPECT_NEAR(palette[joint][column][row], column == row ? 1.0F : 0.0F, 1e-5F)
                    << joint_name(joint);
            }
        }
    }
}

TEST(Palette, moves_with_the_hips) {
    Pose pose = mannequin().bind_pose;
    pose.hips_position += glm::vec3{1.0F, 2.0F, 3.0F};
    std::array<glm::mat4, kPaletteSize> palette{};
    skinning_palette(mannequin(), pose, palette);
    for (const glm::mat4& matrix : palette) {
        EXPECT_NEAR(matrix[3][0], 1.0F, 1e-5F);
        EXPECT_NEAR(matrix[3][1], 2.0F, 1e-5F);
        EXPECT_NEAR(matrix[3][2], 3.0F, 1e-5F);
    }
}

TEST(Palette, a_mirrored_pose_makes_the_mirrored_body) {
    const Pose pose = mannequin_test_pose("side_step");
    const std::vector<glm::vec3> one = posed(pose);
    const std::vector<glm::vec3> other = posed(motion::mirrored(pose));
    for (std::size_t i = 0; i < one.size(); ++i) {
        const glm::vec3 image = other[i ^ 1U];
        ASSERT_NEAR(glm::length(one[i] - glm::vec3(-image.x, image.y, image.z)), 0.0F, 1e-5F);
    }
}

TEST(Palette, is_made_without_allocation_or_lock) {
    const Pose pose = mannequin_test_pose("over");
    std::array<glm::mat4, kPaletteSize> palette{};
    const Avatar& avatar = mannequin();
    raks::test::RealtimeScope scope;
    skinning_palette(avatar, pose, palette);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_GT(glm::length(palette[0][0]), 0.9F);
}

TEST(HelperJoints, take_half_of_an_elbow_bend) {
    const HelperJoint& elbow = mannequin().helpers[2];
    ASSERT_EQ(elbow.name, "leftElbowHalf");
    const glm::quat half = helper_rotation(elbow, turn(-140.0F, {0.0F, 1.0F, 0.0F}));
    EXPECT_NEAR(angle_between(half, turn(-70.0F, {0.0F, 1.0F, 0.0F})), 0.0F, 0.1F);
}

TEST(HelperJoints, split_a_rotation_into_swing_and_roll) {
    const auto& helpers = mannequin().helpers;
    const glm::quat swing = turn(60.0F, kZ);
    const glm::quat roll = turn(80.0F, kX);
    const glm::quat both = swing * roll;
    EXPECT_NEAR(angle_between(helper_rotation(helpers[0], both), turn(30.0F, kZ)), 0.0F, 0.1F);
    EXPECT_NEAR(
        angle_between(helper_rotation(helpers[1], both), swing * turn(40.0F, kX)), 0.0F, 0.1F);
    ASSERT_EQ(helpers[3].kind, HelperKind::half_roll);
    EXPECT_NEAR(angle_between(helper_rotation(helpers[3], both), turn(40.0F, kX)), 0.0F, 0.1F);
}

TEST(HelperJoints, do_not_jump_when_a_limb_swings_through_180_degrees) {
    const HelperJoint& twist = mannequin().helpers[1];
    glm::quat before = helper_rotation(twist, turn(150.0F, kZ) * turn(30.0F, kX));
    for (int degrees = 151; degrees < 180; ++degrees) {
        const glm::quat now =
            helper_rotation(twist, turn(static_cast<float>(degrees), kZ) * turn(30.0F, kX));
        ASSERT_LT(angle_between(before, now), 6.0F) << degrees;
        before = now;
    }
}

TEST(ShoulderRhythm, leaves_arms_below_the_horizontal_alone) {
    for (const std::string_view name : {"T", "bind", "down", "side_step", "twist", "wrist"}) {
        const Pose& pose = mannequin_test_pose(name);
        const Pose shown = with_shoulder_rhythm(pose);
        for (std::size_t i = 0; i < pose.local_rotations.size(); ++i) {
            ASSERT_LT(angle_between(shown.local_rotations[i], pose.local_rotations[i]), 0.1F)
                << name << ' ' << motion::kBoneNames[i];
        }
    }
}

TEST(ShoulderRhythm, raises_the_collar_bone_by_30_degrees_at_the_top) {
    EXPECT_NEAR(collar_rise(with_shoulder_rhythm(arms_at(90.0F))), 30.0F, 0.2F);
    EXPECT_NEAR(collar_rise(with_shoulder_rhythm(arms_at(45.0F))), 12.0F, 0.2F);
}

TEST(ShoulderRhythm, keeps_the_direction_of_the_arm_in_the_world) {
    const Pose pose = arms_at(80.0F);
    const Pose shown = with_shoulder_rhythm(pose);
    for (const Side side : motion::kSides) {
        const Bone hand = motion::on_side(Bone::left_hand, side);
        const auto& skeleton = mannequin().skeleton;
        EXPECT_LT(angle_between(motion::world_pose(skeleton, pose).rotation(hand),
                                motion::world_pose(skeleton, shown).rotation(hand)),
                  0.1F);
    }
}

TEST(ShoulderRhythm, adds_nothing_to_a_collar_bone_that_is_up_already) {
    Pose pose = arms_at(60.0F);
    pose.rotation(Bone::left_shoulder) = turn(30.0F, kZ);
    EXPECT_NEAR(collar_rise(with_shoulder_rhythm(pose)), 30.0F, 0.1F);
}

TEST(ShoulderRhythm, moves_without_jumps) {
    float before = collar_rise(with_shoulder_rhythm(arms_at(-90.0F)));
    for (int elevation = -89; elevation <= 90; ++elevation) {
        const float now = collar_rise(with_shoulder_rhythm(arms_at(static_cast<float>(elevation))));
        ASSERT_LT(std::abs(now - before), 0.5F) << elevation;
        before = now;
    }
}

}  // namespace
}  // namespace raks::render::test
