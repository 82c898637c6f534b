#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/dance/beat_phase.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/dance/hand_hold.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// Distance from shoulder to hand, of the arm's length.
float reach_of(const Pose& pose, Side side) {
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    const glm::vec3 shoulder = world.position(on_side(Bone::left_upper_arm, side));
    const glm::vec3 elbow = world.position(on_side(Bone::left_lower_arm, side));
    const glm::vec3 hand = world.position(on_side(Bone::left_hand, side));
    return glm::distance(shoulder, hand) /
           (glm::distance(shoulder, elbow) + glm::distance(elbow, hand));
}

/// One who faces the other, `aside` along x.
Pose partner(float aside) {
    Pose pose;
    pose.rotation(Bone::hips) = glm::angleAxis(3.14159265F, glm::vec3(0, 1, 0));
    pose.hips_position = {aside, 0.0F, 0.35F};
    return pose;
}

TEST(Hands, that_hold_one_another_neither_stretch_nor_fold_the_arm) {
    const Pose lead;  // T-pose: the left hand points along +x
    for (int step = 0; step < 60; ++step) {
        Pose one = lead;
        Pose other = partner(0.03F * static_cast<float>(step) - 0.5F);
        const Pose before = other;
        const float hold = wish_to_hold(mannequin_skeleton(), one, other);
        join_hands(mannequin_skeleton(), hold, one, other);
        const bool is_moved =
            one.rotation(Bone::left_upper_arm) != lead.rotation(Bone::left_upper_arm);
        if (is_moved) {
            EXPECT_LT(reach_of(one, Side::left), 0.96F) << step;
            EXPECT_GT(reach_of(one, Side::left), 0.42F) << step;
            EXPECT_LT(reach_of(other, Side::right), 0.96F) << step;
            EXPECT_GT(reach_of(other, Side::right), 0.42F) << step;
        } else {
            EXPECT_EQ(other.rotation(Bone::right_upper_arm),
                      before.rotation(Bone::right_upper_arm));
        }
    }
}

/// How far the lead's hand is from where it would be by itself, by hop: the partner is near, and
/// from hop 100 on, at once, out of reach.
std::vector<float> pulls_when_torn_apart() {
    std::vector<float> pulls;
    PoseTrack lead;
    PoseTrack follow;
    HandHold hold;
    const Skeleton& skeleton = mannequin_skeleton();
    const auto partner_at = [](HopIndex hop) { return partner(hop < 100 ? 0.3F : 4.0F); };
    const glm::vec3 free = world_pose(skeleton, Pose()).position(Bone::left_hand);
    for (HopIndex hop = 0; hop < 200; ++hop) {
        lead.append_final(hop, Pose());
        follow.append_final(hop, partner_at(hop));
        for (int ahead = 1; ahead <= PoseTrack::kPredictedPoses; ++ahead) {
            lead.set_predicted(ahead, Pose());
            follow.set_predicted(ahead, partner_at(hop + ahead));
        }
        hold.advance(skeleton, lead, follow);
        const Pose& shown = lead.at_hop(hop);
        pulls.push_back(glm::distance(world_pose(skeleton, shown).position(Bone::left_hand), free));
    }
    return pulls;
}

TEST(Hands, let_go_before_they_are_torn_apart) {
    const std::vector<float> pulls = pulls_when_torn_apart();
    EXPECT_GT(pulls[70], 0.05F) << "they hold one another";
    EXPECT_LT(pulls[97], 0.8F * pulls[70]) << "what comes is known";
    EXPECT_EQ(pulls[150], 0.0F);
}

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
