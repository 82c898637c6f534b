// Figures of joint positions, danced: bodies made from places, and the salsa that ships.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/random.hpp"
#include "motion/dance/baking/arms.hpp"
#include "motion/dance/baking/feature_pose.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"
#include "training/figures/figure_trainer.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kSalsaBpm = 171.0;
constexpr HopIndex kHopsAMinute = 6000;

std::vector<Bone> placed_bones() {
    std::vector<Bone> bones;
    for (const Part part : parts_of(FigureFeatures::positions)) {
        const std::vector<Bone> own = default_joints(part, FigureFeatures::positions);
        bones.insert(bones.end(), own.begin(), own.end());
    }
    return bones;
}

/// Real postures: a minute of the angle dancer.
const std::vector<Pose>& postures() {
    static const std::vector<Pose> poses =
        test::dance_to(test::steady_music(kSalsaBpm), kHopsAMinute / 2);
    return poses;
}

TEST(PoseAtPlaces, gives_back_a_body_whose_joints_are_there) {
    const Skeleton& skeleton = mannequin_skeleton();
    for (std::size_t i = 0; i < postures().size(); i += 37) {
        const WorldPose before = world_pose(skeleton, postures()[i]);
        const WorldPose after = world_pose(skeleton, pose_at(skeleton, before.positions));
        for (const Bone bone : placed_bones()) {
            EXPECT_LT(glm::distance(before.position(bone), after.position(bone)), 0.012F)
                << i << ": " << kBoneNames[index_of(bone)];
        }
        for (const Side side : kSides) {
            const Bone hand = on_side(Bone::left_hand, side);
            const Bone foot = on_side(Bone::left_foot, side);
            EXPECT_LT(glm::distance(before.position(hand), after.position(hand)), 0.003F) << i;
            EXPECT_LT(glm::distance(before.position(foot), after.position(foot)), 0.003F) << i;
        }
    }
}

TEST(PoseAtPlaces, moves_with_the_places) {
    // The same places elsewhere, turned: the same body elsewhere.
    const Skeleton& skeleton = mannequin_skeleton();
    const glm::quat turn = glm::angleAxis(2.5F, glm::vec3(0, 1, 0));
    JointPlaces places = world_pose(skeleton, postures()[1500]).positions;
    const WorldPose here = world_pose(skeleton, pose_at(skeleton, places));
    for (glm::vec3& place : places) {
        place = turn * place + glm::vec3(1.0F, 0.0F, -3.0F);
    }
    const WorldPose there = world_pose(skeleton, pose_at(skeleton, places));
    for (std::size_t bone = 0; bone < places.size(); ++bone) {
        const glm::vec3 expected = turn * here.positions[bone] + glm::vec3(1.0F, 0.0F, -3.0F);
        EXPECT_LT(glm::distance(there.positions[bone], expected), 1e-4F);
    }
}

TEST(PoseAtPlaces, noise_on_the_places_moves_no_joint_much_further) {
    // Places drawn from Gaussians keep no bone's length; the body does, and stays near them.
    const Skeleton& skeleton = mannequin_skeleton();
    const CounterRandom random(7);
    constexpr float kNoise = 0.01F;
    float farthest = 0.0F;
    std::uint64_t draw = 0;
    for (std::size_t i = 1000; i < postures().size(); i += 37) {
        const WorldPose before = world_pose(skeleton, postures()[i]);
        JointPlaces places = before.positions;
        for (glm::vec3& place : places) {
            for (int axis = 0; axis < 3; ++axis) {
                place[axis] += kNoise * static_cast<float>(random.normal(draw++));
            }
        }
        const WorldPose after = world_pose(skeleton, pose_at(skeleton, places));
        for (const Bone bone : placed_bones()) {
            farthest =
                std::max(farthest, glm::distance(before.position(bone), after.position(bone)));
        }
    }
    EXPECT_LT(farthest, 10.0F * kNoise);
}

TEST(PoseAtPlaces, places_that_point_nowhere_still_give_a_body) {
    const Skeleton& skeleton = mannequin_skeleton();
    JointPlaces places{};
    std::vector<JointPlaces> bad = {places};
    places.fill(glm::vec3(0.0F, 1.0F, 0.0F));
    places[index_of(Bone::left_foot)] = {0.0F, 0.0F, 0.0F};
    bad.push_back(places);
    places = world_pose(skeleton, Pose{}).positions;  // straight limbs, a T
    bad.push_back(places);
    for (const Bone bone : placed_bones()) {
        places = world_pose(skeleton, Pose{}).positions;
        places[index_of(bone)] = places[kBoneParents[index_of(bone)]];
        bad.push_back(places);
    }
    for (const JointPlaces& one : bad) {
        const Pose pose = pose_at(skeleton, one);
        for (const glm::quat& rotation : pose.local_rotations) {
            EXPECT_NEAR(glm::length(rotation), 1.0F, 1e-3F);
        }
    }
}

/// An upper part of positions whose left arm swings by `angle(i)` and is `length(i)` of its own.
struct SwingingArm {
    PartModel part;
    FeatureTrack track;
};
template <typename Angle, typename Length>
SwingingArm swinging_arm(Angle angle, Length length) {
    SwingingArm arm;
    arm.part.part = Part::upper;
    arm.part.features = FigureFeatures::positions;
    for (const Bone bone : default_joints(Part::upper, FigureFeatures::positions)) {
        arm.part.joints.push_back({bone});
    }
    const Skeleton& body = mannequin_skeleton();
    arm.track.columns = arm.part.dimension();
    arm.track.values.resize(192 * arm.track.columns);
    for (std::size_t i = 0; i < 192; ++i) {
        Pose pose;
        pose.rotation(Bone::left_upper_arm) =
            glm::angleAxis(static_cast<float>(angle(i)), glm::vec3(0, 0, 1));
        pose.rotation(Bone::left_lower_arm) = glm::angleAxis(-1.0F, glm::vec3(0, 1, 0));
        const WorldPose world = world_pose(body, pose);
        const glm::vec3 shoulder = world.position(Bone::left_upper_arm);
        for (std::size_t j = 0; j < arm.part.joints.size(); ++j) {
            const Bone bone = arm.part.joints[j].bone;
            const bool is_arm = bone == Bone::left_lower_arm || bone == Bone::left_hand;
            const float share = is_arm ? static_cast<float>(length(i)) : 1.0F;
            const glm::vec3 place = shoulder + share * (world.position(bone) - shoulder);
            for (int axis = 0; axis < 3; ++axis) {
                arm.track.row(i)[3 * j + static_cast<std::size_t>(axis)] =
                    static_cast<double>(place[axis]);
            }
        }
    }
    return arm;
}

glm::dvec3 joint_at(const SwingingArm& arm, std::size_t row, Bone bone) {
    for (std::size_t j = 0; j < arm.part.joints.size(); ++j) {
        if (arm.part.joints[j].bone == bone) {
            const auto values = arm.track.row(row).subspan(3 * j, 3);
            return {values[0], values[1], values[2]};
        }
    }
    return {};
}

TEST(RestoreArms, gives_back_the_lengths_and_keeps_the_directions) {
    const Skeleton& body = mannequin_skeleton();
    const auto swing = [](std::size_t i) {
        return -1.0 + 0.5 * std::sin(2.0 * M_PI * static_cast<double>(i) / 192.0);
    };
    const SwingingArm whole = swinging_arm(swing, [](std::size_t) { return 1.0; });
    SwingingArm arm = swinging_arm(swing, [](std::size_t) { return 0.7; });
    restore_arms(arm.part, body, arm.track);
    for (std::size_t i = 0; i < 192; ++i) {
        const glm::dvec3 elbow = joint_at(arm, i, Bone::left_lower_arm);
        const glm::dvec3 hand = joint_at(arm, i, Bone::left_hand);
        EXPECT_LT(glm::distance(elbow, joint_at(whole, i, Bone::left_lower_arm)), 0.01) << i;
        EXPECT_LT(glm::distance(hand, joint_at(whole, i, Bone::left_hand)), 0.04) << i;
        EXPECT_NEAR(glm::distance(hand, elbow),
                    static_cast<double>(glm::length(body.offsets[index_of(Bone::left_hand)])),
                    1e-6);
    }
}

TEST(RestoreArms, an_arm_that_vanishes_in_the_mean_swings_over_without_a_jump) {
    // Up for half of the figure, down for the other; between them the mean is almost no arm.
    const auto up = [](std::size_t i) {
        return std::tanh(8.0 * std::cos(2.0 * M_PI * static_cast<double>(i) / 192.0));
    };
    SwingingArm arm = swinging_arm([&](std::size_t i) { return 1.4 * (up(i) > 0.0 ? 1.0 : -1.0); },
                                   [&](std::size_t i) { return std::max(0.05, std::abs(up(i))); });
    restore_arms(arm.part, mannequin_skeleton(), arm.track);
    double farthest = 0.0;
    for (std::size_t i = 0; i < 192; ++i) {
        farthest = std::max(farthest,
                            glm::distance(joint_at(arm, i, Bone::left_hand),
                                          joint_at(arm, (i + 1) % 192, Bone::left_hand)));
    }
    EXPECT_LT(farthest, 0.2) << "metres in a twenty-fourth of a beat; the jump was 0.9";
    EXPECT_GT(joint_at(arm, 0, Bone::left_hand).y - joint_at(arm, 96, Bone::left_hand).y, 0.6);
}

struct PositionDance {
    std::vector<Pose> poses;
    std::vector<DancerStatus> status;
};

PositionDance dance_positions(std::uint64_t seed, HopIndex hops) {
    Dancer dancer;
    EXPECT_TRUE(dancer.prepare(test::position_library(), mannequin_skeleton(), seed));
    const auto track = std::make_unique<PoseTrack>();
    PositionDance danced;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        dancer.advance(test::sure_state(hop, test::steady_grid(kSalsaBpm)), *track);
        danced.poses.push_back(track->at_hop(hop));
        danced.status.push_back(dancer.status());
    }
    return danced;
}

TEST(PositionDance, the_same_seed_dances_the_same_and_another_seed_another_dance) {
    const PositionDance first = dance_positions(1, kHopsAMinute / 2);
    const PositionDance again = dance_positions(1, kHopsAMinute / 2);
    const PositionDance other = dance_positions(2, kHopsAMinute / 2);
    float apart = 0.0F;
    for (std::size_t i = 0; i < first.poses.size(); ++i) {
        ASSERT_EQ(first.poses[i].hips_position, again.poses[i].hips_position) << i;
        ASSERT_EQ(first.poses[i].local_rotations, again.poses[i].local_rotations) << i;
        apart = std::max(apart,
                         glm::distance(first.poses[i].hips_position, other.poses[i].hips_position));
    }
    EXPECT_GT(apart, 0.1F);
}

TEST(PositionDance, shares_figures_and_phase_with_the_angle_dancer) {
    Dancer positions;
    Dancer angles;
    ASSERT_TRUE(positions.prepare(test::position_library(), mannequin_skeleton(), 1));
    ASSERT_TRUE(angles.prepare(test::salsa_library(), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    for (HopIndex hop = 0; hop < kHopsAMinute; ++hop) {
        const MusicState music = test::sure_state(hop, test::steady_grid(kSalsaBpm));
        positions.advance(music, *track);
        angles.advance(music, *track);
        const DancerStatus a = positions.status();
        const DancerStatus b = angles.status();
        ASSERT_EQ(a.figure, b.figure) << hop;
        ASSERT_NEAR(a.phase, b.phase, 1e-6) << hop;
    }
}

TEST(PositionDance, feet_stand_and_nothing_jerks_joins_included) {
    const PositionDance danced = dance_positions(4, 2 * kHopsAMinute);
    const auto settled = std::span(danced.poses).subspan(1000);
    const BodyTrack track = body_track(mannequin_skeleton(), resampled(settled, 100.0, 60.0), 60.0);
    const ContactReport contacts = contacts_of(track, 0.0);
    EXPECT_LE(contacts.slip_median, 0.015);
    EXPECT_LE(contacts.slip_p90, 0.027);
    EXPECT_GE(contacts.lowest_toe, -0.005);
    EXPECT_LE(jerk_of(track).highest, 3.0 * 1408.0) << "three times people's 99.9th percentile";
}

TEST(PositionDance, keeps_the_real_time_rules) {
    Dancer dancer;
    ASSERT_TRUE(dancer.prepare(test::position_library(), mannequin_skeleton(), 1));
    const auto track = std::make_unique<PoseTrack>();
    raks::test::RealtimeScope scope;
    for (HopIndex hop = 0; hop < kHopsAMinute; ++hop) {
        dancer.advance(test::sure_state(hop, test::steady_grid(kSalsaBpm)), *track);
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
