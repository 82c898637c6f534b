// What is measured of an avatar in a dance, on the mannequin, whose truth is known.
#include "engine/trials/avatar_measures.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "motion/dance/standing.hpp"
#include "render/mannequin/mannequin.hpp"

namespace raks::engine {
namespace {

constexpr double kPictureRate = 10.0;

const render::Avatar& mannequin_avatar() {
    static const render::Avatar avatar = render::build_mannequin();
    return avatar;
}

std::vector<motion::Pose> stood_still(std::size_t poses = 20) {
    std::vector<motion::Pose> stood;
    for (std::size_t i = 0; i < poses; ++i) {
        stood.push_back(
            motion::idle_pose(mannequin_avatar().skeleton,
                              stream_time_from_seconds(static_cast<double>(i) / kPictureRate)));
    }
    return stood;
}

TEST(AvatarMeasures, of_one_who_stands_find_nothing_wrong) {
    const AvatarMeasures is = measure_avatar(mannequin_avatar(), stood_still(), kPictureRate);
    EXPECT_NEAR(is.lowest_sole, 0.0, 0.006);
    EXPECT_EQ(is.planted_share, 1.0);
    EXPECT_LT(is.planted_p99, 0.006);
    EXPECT_EQ(is.hands.inside_share, 0.0);
    EXPECT_LT(is.stretch_p995, 2.0);
    ASSERT_TRUE(is.mirrored_p99);
    EXPECT_LT(*is.mirrored_p99, 0.001);
    ASSERT_TRUE(is.tails) << "hair and skirt";
    EXPECT_TRUE(is.tails->is_finite);
}

TEST(AvatarMeasures, tell_how_deep_soles_are_in_the_floor_and_how_far_planted_ones_hang_over_it) {
    std::vector<motion::Pose> sunk = stood_still();
    for (motion::Pose& pose : sunk) {
        pose.hips_position.y -= 0.04F;
    }
    EXPECT_NEAR(measure_avatar(mannequin_avatar(), sunk, kPictureRate).lowest_sole, -0.04, 0.006);
    std::vector<motion::Pose> lifted = stood_still();
    lifted.back().hips_position.y += 0.05F;
    const AvatarMeasures is = measure_avatar(mannequin_avatar(), lifted, kPictureRate);
    EXPECT_NEAR(is.planted_share, 0.95, 1e-6);
    EXPECT_GT(is.planted_p99, 0.02);
}

TEST(AvatarMeasures, tell_a_forearm_that_is_put_through_the_trunk) {
    std::vector<motion::Pose> poses = stood_still();
    for (std::size_t i = 0; i < 5; ++i) {
        // The arm hangs, the elbow bends square to the inside.
        poses[i].rotation(motion::Bone::left_upper_arm) = glm::angleAxis(-1.5F, glm::vec3(0, 0, 1));
        poses[i].rotation(motion::Bone::left_lower_arm) = glm::angleAxis(-1.5F, glm::vec3(0, 0, 1));
    }
    const AvatarMeasures is = measure_avatar(mannequin_avatar(), poses, kPictureRate);
    EXPECT_GT(is.hands.deepest, 0.05);
    EXPECT_NEAR(is.hands.inside_share, 0.25, 0.06);
}

TEST(AvatarMeasures, tell_skin_that_is_torn) {
    std::vector<motion::Pose> poses = stood_still();
    for (motion::Pose& pose : poses) {
        pose.rotation(motion::Bone::spine) = glm::angleAxis(2.9F, glm::vec3(0, 1, 0));
    }
    const double torn = measure_avatar(mannequin_avatar(), poses, kPictureRate).stretch_p995;
    EXPECT_GT(torn, measure_avatar(mannequin_avatar(), stood_still(), kPictureRate).stretch_p995);
}

TEST(AvatarMeasures, of_no_pose_are_none) {
    EXPECT_EQ(measure_avatar(mannequin_avatar(), {}, kPictureRate).hands.deepest, 0.0);
}

}  // namespace
}  // namespace raks::engine
