#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/dance/beat_phase.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

TEST(Limb, keeps_its_elbow_as_it_passes_through_straight) {
    const Skeleton& skeleton = mannequin_skeleton();
    glm::vec3 last{};
    for (int step = 0; step <= 400; ++step) {
        Pose pose;
        // The elbow bends behind first, at last ahead: no elbow does, a mean over repeats may.
        const float bend = 0.4F - 0.002F * static_cast<float>(step);
        pose.rotation(Bone::left_lower_arm) = glm::angleAxis(-bend, glm::vec3(0, 1, 0));
        const WorldPose free = world_pose(skeleton, pose);
        const Limb arm = arm_of(free, Side::left);
        solve_limb(skeleton, arm, arm.root + glm::vec3(0.3F, -0.2F, 0.1F), pose);
        const glm::vec3 elbow = world_pose(skeleton, pose).position(Bone::left_lower_arm);
        EXPECT_TRUE(std::isfinite(elbow.x)) << step;
        if (bend > 0.0F) {
            EXPECT_TRUE(step == 0 || glm::distance(elbow, last) < 0.01F) << step;
            last = elbow;
        }
    }
}

TEST(Hands, are_led_round_a_body_that_they_would_cut_through) {
    const Skeleton& skeleton = mannequin_skeleton();
    constexpr double kSamplesPerBeat = 48.0;
    std::vector<Pose> poses(192);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        // The left hand hangs, and sweeps across the belly and back within a beat.
        const float away = (static_cast<float>(i) - 96.0F) / 12.0F;
        const float swing = std::exp(-0.5F * away * away);
        poses[i].rotation(Bone::left_upper_arm) =
            glm::angleAxis(-1.3F - 0.5F * swing, glm::vec3(0, 0, 1));
        poses[i].rotation(Bone::left_lower_arm) = glm::angleAxis(-1.2F * swing, glm::vec3(0, 0, 1));
    }
    const double before = hand_clearance(skeleton, poses[96]).metres;
    lead_hands_round(skeleton, kSamplesPerBeat, poses);
    const double after = hand_clearance(skeleton, poses[96]).metres;
    EXPECT_LT(before, -0.05);
    EXPECT_GT(after, -0.02);
    const glm::quat still = glm::angleAxis(-1.3F, glm::vec3(0, 0, 1));
    EXPECT_GT(std::abs(glm::dot(poses[0].rotation(Bone::left_upper_arm), still)), 0.99F);
}

TEST(Octave, of_two_as_far_from_the_learnt_tempo_is_the_slower) {
    const DanceMetre salsa{Bpm(170.0), 4};
    EXPECT_EQ(choose_octave(Bpm(120.0), salsa, 0.0), 1.0) << "0.706, not 1.412";
    EXPECT_EQ(choose_octave(Bpm(118.0), salsa, 0.0), 2.0) << "0.694 would be too slow";
}

TEST(Jerk, knows_no_stop_where_a_track_is_cut_off) {
    BodyTrack track;
    for (int f = 0; f < 60; ++f) {  // everything glides at 2 m/s
        track.joints.emplace_back().fill(glm::dvec3(f / 30.0, 1.0, 0.0));
        track.feet.emplace_back();
    }
    MetricFrames cut_out;
    cut_out.counted.assign(track.frames(), true);
    EXPECT_LT(jerk_of(track, cut_out).highest, 1e-6);
}

}  // namespace
}  // namespace raks::motion
