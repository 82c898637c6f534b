// Arms of one who dances a couples' dance alone.
#include "motion/dance/dynamics/solo_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Of the arm's length: elbows and wrists of the skeleton are not quite in one line with the
// shoulder.
constexpr float kNear = 0.01F;

/// Each pattern holds both hands still at a height of its own from beat 2 to 6.
SoloArms arms(std::size_t patterns) {
    SoloArms solo;
    for (std::size_t i = 0; i < patterns; ++i) {
        ArmPattern pattern;
        const glm::vec3 wrist(0.3F, -0.5F + 0.2F * static_cast<float>(i), 0.5F);
        pattern.keys = {{{{2.0, wrist}, {6.0, wrist}}, {{2.0, wrist}, {6.0, wrist}}}};
        solo.patterns.push_back(pattern);
    }
    return solo;
}

/// A wrist from its shoulder, in lengths of the arm, in the frame of the chest.
glm::vec3 wrist_of(const Pose& pose, Side side) {
    const Skeleton& skeleton = mannequin_skeleton();
    const WorldPose world = world_body(skeleton, pose);
    const float length =
        glm::length(skeleton.offsets[index_of(on_side(Bone::left_lower_arm, side))]) +
        glm::length(skeleton.offsets[index_of(on_side(Bone::left_hand, side))]);
    return glm::conjugate(world.rotation(Bone::upper_chest)) *
           (world.position(on_side(Bone::left_hand, side)) -
            world.position(on_side(Bone::left_upper_arm, side))) /
           length;
}

Pose danced(const SoloArms& solo, double phase, float size = 1.0F) {
    Pose pose;
    pose.rotation(Bone::chest) = glm::angleAxis(0.3F, glm::vec3(1, 0, 0));
    dance_solo_arms(solo, {phase, 1, size}, mannequin_skeleton(), pose);
    return pose;
}

TEST(SoloArms, arrive_near_their_keys_and_wait_there) {
    const SoloArms solo = arms(1);
    for (const Side side : kSides) {
        const glm::vec3 there = wrist_of(danced(solo, 2.0), side);
        // Up to 18 % of the way from home are drawn anew each time.
        EXPECT_LT(glm::distance(there, glm::vec3(side == Side::left ? 0.3F : -0.3F, -0.5F, 0.5F)),
                  0.05F);
        for (const double beat : {3.0, 4.9}) {
            EXPECT_LT(glm::distance(wrist_of(danced(solo, beat), side), there), kNear) << beat;
        }
        EXPECT_GT(glm::distance(wrist_of(danced(solo, 18.0), side), there), 1e-4F)
            << "no two times are alike";
    }
    EXPECT_LT(glm::distance(wrist_of(danced(solo, 8.0), Side::left), solo.home), kNear);
    EXPECT_LT(glm::distance(wrist_of(danced(solo, 3.0, 0.0F), Side::left), solo.home), kNear)
        << "no size";
}

TEST(SoloArms, never_dance_one_pattern_twice_running) {
    const SoloArms solo = arms(4);
    std::vector<float> heights;
    heights.reserve(200);
    for (int pattern = 0; pattern < 200; ++pattern) {
        heights.push_back(wrist_of(danced(solo, 8.0 * pattern + 4.0), Side::left).y);
    }
    for (std::size_t i = 1; i < heights.size(); ++i) {
        EXPECT_GT(std::abs(heights[i] - heights[i - 1]), 0.05F) << i;
    }
    std::sort(heights.begin(), heights.end());
    EXPECT_LT(heights.front(), -0.45F);
    EXPECT_GT(heights.back(), 0.0F) << "the first and the last are danced";
}

TEST(SoloArms, go_on_without_a_leap) {
    const SoloArms solo = arms(4);
    glm::vec3 before = wrist_of(danced(solo, 0.0), Side::right);
    for (double phase = 0.01; phase < 64.0; phase += 0.01) {
        const glm::vec3 now = wrist_of(danced(solo, phase), Side::right);
        ASSERT_LT(glm::distance(now, before), 0.03F) << phase;
        before = now;
    }
}

TEST(SoloArms, without_patterns_the_figures_arms_stay) {
    const Pose pose = danced(SoloArms(), 3.0);
    EXPECT_EQ(pose.rotation(Bone::left_upper_arm), kNoRotation);
}

}  // namespace
}  // namespace raks::motion
