// Alignment: a motion that was turned, moved, tilted or made larger is found again.
#include "motion/evaluate/motion_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/evaluate/motion_comparison.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

/// Somebody who walks along a circle and waves.
BodyTrack circling() {
    std::vector<Pose> poses;
    for (int i = 0; i < 120; ++i) {
        const float at = 0.05F * static_cast<float>(i);
        Pose pose;
        pose.hips_position = {std::sin(at), 0.93F, std::cos(at)};
        pose.rotation(Bone::hips) = glm::angleAxis(at, glm::vec3(0.0F, 1.0F, 0.0F));
        pose.rotation(Bone::left_upper_arm) = glm::angleAxis(at, glm::vec3(0.0F, 0.0F, 1.0F));
        poses.push_back(pose);
    }
    return body_track(mannequin_skeleton(), poses, 60.0);
}

template <typename Change>
BodyTrack changed(BodyTrack track, const Change& change) {
    for (std::size_t frame = 0; frame < track.frames(); ++frame) {
        for (glm::dvec3& joint : track.joints[frame]) {
            joint = change(joint);
        }
        for (SourceFoot& foot : track.feet[frame]) {
            foot.ankle = change(foot.ankle);
            foot.toe_tip = change(foot.toe_tip);
        }
    }
    return track;
}

TEST(MotionAlignment, finds_the_turn_and_the_move) {
    const BodyTrack one = circling();
    for (const double degrees : {0.0, 30.0, -100.0, 179.0}) {
        const glm::dquat turn = glm::angleAxis(degrees * M_PI / 180.0, glm::dvec3(0.0, 1.0, 0.0));
        BodyTrack other = changed(one, [&](const glm::dvec3& joint) {
            return turn * joint + glm::dvec3(2.0, 0.1, -1.0);
        });
        const auto found = align_motion(one, other);
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_NEAR(found->turn, -degrees, 1e-6);
        EXPECT_NEAR(found->scale, 1.0, 1e-9);
        EXPECT_NEAR(found->tilt, 0.0, 1e-4);
        const auto left = compare_motions(one, other);
        ASSERT_TRUE(left);
        EXPECT_NEAR(left->world, 0.0, 1e-9);
        EXPECT_NEAR(left->toes[0].world, 0.0, 1e-9);
    }
}

TEST(MotionAlignment, tells_tilt_and_scale_and_leaves_both_as_they_are) {
    const BodyTrack one = circling();
    const glm::dquat tilt = glm::angleAxis(4.0 * M_PI / 180.0, glm::dvec3(0.6, 0.0, 0.8));
    BodyTrack other = changed(one, [&](const glm::dvec3& joint) { return 1.05 * (tilt * joint); });
    const auto found = align_motion(one, other);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->tilt, 4.0, 1e-6);
    EXPECT_NEAR(found->scale, 1.05, 1e-9);
    const auto left = compare_motions(one, other);
    ASSERT_TRUE(left);
    EXPECT_GT(left->world, 0.03);
}

TEST(MotionAlignment, needs_a_moment_in_common) {
    const BodyTrack one = circling();
    BodyTrack other = one;
    EXPECT_FALSE(align_motion(one, other, 100.0));
}

}  // namespace
}  // namespace raks::motion
