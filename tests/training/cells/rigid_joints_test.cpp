#include "training/cells/rigid_joints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/figures/motion_features.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Bends a bone about z, frame by frame further.
void bend(std::vector<Pose>& poses, Bone bone, float angle) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(poses.size() - 1);
        poses[i].rotation(bone) = glm::angleAxis(share * angle, glm::vec3(0, 0, 1));
    }
}

double angle_of(const glm::quat& rotation) {
    return glm::length(exponential_map(glm::dquat(rotation)));
}

TEST(RigidJoints, a_trunk_of_one_joint_bends_in_two_and_the_chest_stays_as_it_was) {
    std::vector<Pose> poses(5);
    bend(poses, Bone::chest, 1.0F);
    ASSERT_TRUE(spread_trunk(poses));
    EXPECT_NEAR(angle_of(poses.back().rotation(Bone::spine)), 0.73, 1e-5);
    EXPECT_NEAR(angle_of(poses.back().rotation(Bone::chest)), 0.27, 1e-5);
    const glm::quat whole = poses.back().rotation(Bone::spine) * poses.back().rotation(Bone::chest);
    EXPECT_NEAR(angle_of(whole), 1.0, 1e-5);
}

TEST(RigidJoints, a_rotation_that_was_halved_is_one) {
    std::vector<Pose> poses(5);
    bend(poses, Bone::spine, 0.5F);
    bend(poses, Bone::chest, 0.5F);
    ASSERT_TRUE(spread_trunk(poses));
    EXPECT_NEAR(angle_of(poses.back().rotation(Bone::spine)), 0.73, 1e-5);
    EXPECT_NEAR(angle_of(poses.back().rotation(Bone::chest)), 0.27, 1e-5);
}

TEST(RigidJoints, a_trunk_of_two_joints_stays) {
    std::vector<Pose> poses(5);
    bend(poses, Bone::spine, 0.3F);
    bend(poses, Bone::chest, 0.6F);
    const std::vector<Pose> before = poses;
    EXPECT_FALSE(spread_trunk(poses));
    EXPECT_EQ(poses.back().local_rotations, before.back().local_rotations);
    std::vector<Pose> still(5);
    EXPECT_FALSE(spread_trunk(still));
}

// A foot that is pitched so far, of a skeleton without other rotations.
std::vector<Pose> pitched(float angle) {
    std::vector<Pose> poses(3);
    for (Pose& pose : poses) {
        for (const Side side : kSides) {
            pose.rotation(on_side(Bone::left_foot, side)) =
                glm::angleAxis(angle, glm::vec3(1, 0, 0));
        }
    }
    return poses;
}

// How deep a point of the foot lies under the ankle.
double depth(const Pose& pose, Side side, glm::vec3 left) {
    left.x = side == Side::left ? left.x : -left.x;
    return -static_cast<double>((pose.rotation(on_side(Bone::left_foot, side)) * left).y);
}

TEST(RigidJoints, a_heel_rolls_until_the_ball_is_as_deep_as_the_tip_was) {
    const Skeleton& skeleton = mannequin_skeleton();
    for (const float angle : {0.2F, 0.4F}) {
        std::vector<Pose> poses = pitched(angle);
        const double tip = depth(poses[0], Side::left, skeleton.toe_tip);
        const std::vector<std::array<SourceFoot, 2>> feet(poses.size());
        ASSERT_TRUE(roll_heels(skeleton, feet, poses));
        for (const Side side : kSides) {
            EXPECT_NEAR(depth(poses[0], side, skeleton.ball), tip, 1e-4) << angle;
        }
    }
}

TEST(RigidJoints, feet_that_lie_flat_are_in_the_air_or_have_toes_stay) {
    const Skeleton& skeleton = mannequin_skeleton();
    std::vector<std::array<SourceFoot, 2>> feet(3);
    std::vector<Pose> flat = pitched(0.0F);
    EXPECT_TRUE(roll_heels(skeleton, feet, flat));
    EXPECT_NEAR(depth(flat[0], Side::left, skeleton.ball), -skeleton.ball.y, 1e-6);
    std::vector<Pose> toes = pitched(0.4F);
    toes[1].rotation(Bone::left_toes) = glm::angleAxis(0.2F, glm::vec3(1, 0, 0));
    const std::vector<Pose> before = toes;
    EXPECT_FALSE(roll_heels(skeleton, feet, toes));
    EXPECT_EQ(toes[0].local_rotations, before[0].local_rotations);
    for (auto& both : feet) {
        both[0].toe_tip.y = both[1].toe_tip.y = 0.1;
    }
    std::vector<Pose> lifted = pitched(0.4F);
    EXPECT_TRUE(roll_heels(skeleton, feet, lifted));
    EXPECT_NEAR(depth(lifted[0], Side::left, skeleton.ball),
                depth(pitched(0.4F)[0], Side::left, skeleton.ball),
                1e-6);
}

}  // namespace
}  // namespace raks::motion
