#include "motion/evaluate/motion_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

/// Somebody who walks along x with 0.6 m/s and lifts the left arm.
BodyTrack walking(double rate, double seconds, const glm::vec3& from = glm::vec3(0.0F)) {
    std::vector<Pose> poses;
    for (int i = 0; i <= static_cast<int>(std::lround(seconds * rate)); ++i) {
        const auto at = static_cast<float>(i / rate);
        Pose pose;
        pose.hips_position = from + glm::vec3(0.6F * at, 0.93F, 0.0F);
        pose.rotation(Bone::left_upper_arm) =
            glm::angleAxis(0.1F * at, glm::vec3(0.0F, 0.0F, 1.0F));
        poses.push_back(pose);
    }
    return body_track(mannequin_skeleton(), poses, rate);
}

TEST(MotionComparison, of_a_motion_with_itself_is_nothing) {
    const auto same = compare_motions(walking(60.0, 2.0), walking(60.0, 2.0));
    ASSERT_TRUE(same) << same.error().message;
    EXPECT_NEAR(same->world, 0.0, 1e-15);
    EXPECT_NEAR(same->from_hips, 0.0, 1e-15);
    EXPECT_NEAR(same->angle, 0.0, 1e-12);
    EXPECT_NEAR(same->seconds, 121.0 / 60.0, 1e-9);
}

TEST(MotionComparison, of_another_place_differs_in_the_world_alone) {
    const auto away = compare_motions(walking(60.0, 1.0), walking(60.0, 1.0, {0.0F, 0.0F, 0.25F}));
    ASSERT_TRUE(away);
    EXPECT_NEAR(away->world, 0.25, 1e-6);
    EXPECT_NEAR(away->from_hips, 0.0, 1e-6);
    for (const JointDifference& toe : away->toes) {
        EXPECT_NEAR(toe.world, 0.25, 1e-6);
    }
}

TEST(MotionComparison, tells_by_how_much_an_arm_is_turned) {
    Pose down;
    down.rotation(Bone::left_upper_arm) = glm::angleAxis(-0.5F, glm::vec3(0.0F, 0.0F, 1.0F));
    const std::vector<Pose> still(10);
    const std::vector<Pose> lower(10, down);
    const auto turned = compare_motions(body_track(mannequin_skeleton(), still, 30.0),
                                        body_track(mannequin_skeleton(), lower, 30.0));
    ASSERT_TRUE(turned);
    for (std::size_t i = 0; i < kBodyBones.size(); ++i) {
        const bool is_below =
            kBodyBones[i] == Bone::left_upper_arm || kBodyBones[i] == Bone::left_lower_arm;
        EXPECT_EQ(turned->joints[i].angle.has_value(),
                  kBodyBones[i] != Bone::head && kBodyBones[i] != Bone::left_hand &&
                      kBodyBones[i] != Bone::right_hand && kBodyBones[i] != Bone::left_foot &&
                      kBodyBones[i] != Bone::right_foot);
        EXPECT_NEAR(turned->joints[i].angle.value_or(0.0), is_below ? 28.648 : 0.0, 0.01)
            << kBoneNames[index_of(kBodyBones[i])];
    }
}

TEST(MotionComparison, compares_the_same_moments_of_other_rates_and_begins) {
    // One begins half a second later, where the other already is.
    const auto later =
        compare_motions(walking(60.0, 3.0), walking(25.0, 2.0, {0.3F, 0.0F, 0.0F}), 0.5);
    ASSERT_TRUE(later);
    EXPECT_NEAR(later->world, 0.0, 0.02);
    EXPECT_NEAR(later->seconds, 2.0, 0.03);
}

TEST(MotionComparison, refuses_motions_that_never_meet) {
    EXPECT_FALSE(compare_motions(walking(60.0, 1.0), walking(60.0, 1.0), 5.0));
    EXPECT_FALSE(compare_motions(BodyTrack{}, walking(60.0, 1.0)));
    EXPECT_FALSE(compare_motions(walking(60.0, 1.0), BodyTrack{}));
}

TEST(MotionComparison, tells_how_fast_toes_are_that_should_stand) {
    const auto standing = [](double speed) {
        std::vector<Pose> poses(61);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            poses[i].hips_position =
                glm::vec3(static_cast<float>(speed * static_cast<double>(i) / 30.0), 0.93F, 0.0F);
        }
        return body_track(mannequin_skeleton(), poses, 30.0);
    };
    const auto slides = compare_motions(standing(0.0), standing(0.35));
    ASSERT_TRUE(slides && slides->planted_toes);
    EXPECT_NEAR(*slides->planted_toes, 0.35, 1e-3);
    // Toes that step are none that slide.
    const auto steps = compare_motions(standing(0.5), standing(0.35));
    ASSERT_TRUE(steps);
    EXPECT_FALSE(steps->planted_toes);
}

}  // namespace
}  // namespace raks::motion
