#include "motion/dance/dynamics/hand_rests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "motion/dance/standing.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::hand_rests_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }

// One who waves both arms and turns the trunk.
Pose waving(StreamTime time) {
    const auto t = static_cast<float>(to_seconds(time));
    Pose pose = idle_pose(body(), time);
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        pose.rotation(on_side(Bone::left_upper_arm, side)) =
            glm::angleAxis(sign * 1.2F * std::sin(4.0F * t), glm::vec3(0, 0, 1)) *
            glm::angleAxis(0.8F * std::sin(3.0F * t), glm::vec3(0, 1, 0));
        pose.rotation(on_side(Bone::left_lower_arm, side)) =
            glm::angleAxis(-sign * (0.8F + 0.6F * std::sin(5.0F * t)), glm::vec3(0, 1, 0));
    }
    pose.rotation(Bone::spine) = glm::angleAxis(0.2F * std::sin(6.0F * t), glm::vec3(1, 0, 0));
    return pose;
}

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

Pose rested(const HandRests& hands, double seconds) {
    Pose pose = waving(at(seconds));
    hands.apply(body(), at(seconds), 2.0 * seconds, pose);
    return pose;
}

TEST(HandRests, a_hand_that_rests_is_still_beside_the_shoulder_while_the_trunk_dances) {
    for (const HandPlace place : {HandPlace::hip,
                                  HandPlace::waist,
                                  HandPlace::chest,
                                  HandPlace::wide,
                                  HandPlace::high,
                                  HandPlace::low,
                                  HandPlace::offered}) {
        HandRests hands;
        hands.go_to(Side::left, place, at(1.0), 0.0, 0.5);
        glm::vec3 first{};
        for (int hop = 0; hop < 200; ++hop) {
            const WorldPose world = world_pose(body(), rested(hands, 1.6 + 0.01 * hop));
            const glm::vec3 wrist =
                world.position(Bone::left_hand) - world.position(Bone::left_upper_arm);
            first = hop == 0 ? wrist : first;
            ASSERT_LT(glm::distance(wrist, first), 0.03F)
                << kHandPlaceNames[static_cast<std::size_t>(place)] << ' ' << hop;
        }
    }
}

// Wrists from one another, at a beat, with both hands at a place. The body stands.
float between_wrists(HandPlace place, double beat, const Skeleton& skeleton = body()) {
    HandRests hands;
    for (const Side side : kSides) {
        hands.go_to(side, place, at(0.0), 0.0, 0.5);
    }
    Pose pose = idle_pose(skeleton, at(0.0));
    hands.apply(skeleton, at(5.0), beat, pose);
    const WorldPose world = world_pose(skeleton, pose);
    return glm::distance(world.position(Bone::left_hand), world.position(Bone::right_hand));
}

TEST(HandRests, hands_clap_on_the_off_beats) {
    for (const double beat : {1.0, 3.0, 5.0}) {
        EXPECT_LT(between_wrists(HandPlace::clap, beat), 0.10F) << beat;
        EXPECT_GT(between_wrists(HandPlace::clap, beat - 1.0), 0.25F) << beat;
    }
}

TEST(HandRests, hands_of_long_and_of_short_arms_clap_where_they_reach) {
    for (const float length : {0.6F, 2.0F}) {
        Skeleton skeleton = body();
        for (const Side side : kSides) {
            skeleton.offsets[index_of(on_side(Bone::left_lower_arm, side))] *= length;
            skeleton.offsets[index_of(on_side(Bone::left_hand, side))] *= length;
        }
        EXPECT_LT(between_wrists(HandPlace::clap, 1.0, skeleton), 0.12F) << length;
    }
}

TEST(HandRests, hands_swing_against_one_another) {
    HandRests hands;
    for (const Side side : kSides) {
        hands.go_to(side, HandPlace::swing, at(0.0), 0.0, 0.5);
    }
    for (const double beat : {0.0, 1.0, 2.0}) {
        Pose pose = idle_pose(body(), at(0.0));
        hands.apply(body(), at(5.0), beat, pose);
        const WorldPose world = world_pose(body(), pose);
        const float apart = world.position(Bone::left_hand).z - world.position(Bone::right_hand).z;
        const float sign = beat == 1.0 ? 1.0F : -1.0F;
        EXPECT_GT(sign * apart, 0.15F) << beat;
    }
}

TEST(HandRests, another_place_is_never_the_last_one) {
    constexpr std::array<HandPlace, 3> kPlaces = {
        HandPlace::swing, HandPlace::snap, HandPlace::clap};
    std::set<HandPlace> seen;
    for (int i = 0; i < 100; ++i) {
        const auto place = another_place(kPlaces, HandPlace::snap, 0.01 * i);
        ASSERT_TRUE(place);
        seen.insert(*place);
    }
    EXPECT_EQ(seen, (std::set<HandPlace>{HandPlace::swing, HandPlace::clap}));
    constexpr std::array<HandPlace, 1> kOne = {HandPlace::hip};
    EXPECT_FALSE(another_place(kOne, HandPlace::hip, 0.5)) << "there is no other";
    EXPECT_EQ(another_place(kOne, std::nullopt, 0.5), HandPlace::hip);
}

TEST(HandRests, the_other_hand_dances_on) {
    HandRests hands;
    hands.go_to(Side::left, HandPlace::hip, at(1.0), 0.0, 0.5);
    const Pose resting = rested(hands, 2.0);
    const Pose dancing = waving(at(2.0));
    EXPECT_EQ(resting.rotation(Bone::right_upper_arm), dancing.rotation(Bone::right_upper_arm));
    EXPECT_NE(resting.rotation(Bone::left_upper_arm), dancing.rotation(Bone::left_upper_arm));
}

TEST(HandRests, no_hand_leaps_however_it_is_sent_about) {
    HandRests hands;
    std::vector<Pose> poses;
    for (int hop = 0; hop < 3000; ++hop) {
        const StreamTime now = at(0.01 * hop);
        const Side side = kSides[static_cast<std::size_t>(hop / 7) % 2];
        if (hop % 37 == 0) {
            hands.go_to(side,
                        static_cast<HandPlace>(hop / 37 % std::ssize(kHandPlaceNames)),
                        now,
                        0.02 * hop,
                        0.5);
        } else if (hop % 53 == 0) {
            hands.let_go(side, now, 0.5);
        }
        Pose pose = waving(now);
        hands.apply(body(), now, 0.02 * hop, pose);
        poses.push_back(pose);
    }
    EXPECT_LT(test::largest_step(poses, 0, 3000), 2.0 * test::kFastestStep);
}

TEST(HandRests, a_hand_let_go_is_where_the_dance_has_it) {
    HandRests hands;
    hands.go_to(Side::right, HandPlace::high, at(0.0), 0.0, 0.4);
    EXPECT_TRUE(hands.rests(Side::right));
    hands.let_go(Side::right, at(2.0), 0.4);
    EXPECT_FALSE(hands.rests(Side::right));
    const Pose pose = rested(hands, 2.41);
    const Pose danced = waving(at(2.41));
    EXPECT_EQ(pose.rotation(Bone::right_lower_arm), danced.rotation(Bone::right_lower_arm));
}

}  // namespace
}  // namespace raks::motion::hand_rests_test
