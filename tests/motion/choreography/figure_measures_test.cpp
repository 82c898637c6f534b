// Bodies whose hands follow the head by a delay that is known.
#include "motion/choreography/figure_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "motion/evaluate/body_track.hpp"

namespace raks::motion {
namespace {

constexpr double kFramesABeat = 30.0;
constexpr int kBeats = 24;

using PlaceAt = std::function<glm::dvec3(double beat)>;

BodyTrack body_of(const PlaceAt& head, const PlaceAt& left_hand, const PlaceAt& right_hand) {
    const auto joint = [](Bone bone) {
        return static_cast<std::size_t>(std::find(kBodyBones.begin(), kBodyBones.end(), bone) -
                                        kBodyBones.begin());
    };
    BodyTrack track;
    for (int i = 0; i < kBeats * static_cast<int>(kFramesABeat); ++i) {
        const double beat = i / kFramesABeat;
        auto& joints = track.joints.emplace_back();
        joints.fill(glm::dvec3(0.0));
        joints[joint(Bone::head)] = head(beat);
        joints[joint(Bone::left_hand)] = left_hand(beat);
        joints[joint(Bone::right_hand)] = right_hand(beat);
    }
    return track;
}

/// To one side and back in 4 beats, with a bounce on each.
glm::dvec3 sway(double beat) {
    return {0.10 * std::sin(M_PI / 2.0 * beat), 0.02 * std::cos(2.0 * M_PI * beat), 0.0};
}

TEST(HandTiming, tells_by_how_many_beats_the_hands_follow) {
    for (const double delay : {-0.3, -0.1, 0.0, 0.15, 0.35}) {
        const PlaceAt hand = [=](double beat) { return 2.0 * sway(beat - delay); };
        const HandTiming timing = hand_timing(body_of(sway, hand, hand), kFramesABeat);
        EXPECT_NEAR(timing.delay, delay, 0.05);
        EXPECT_GT(timing.likeness, 0.98);
    }
}

TEST(HandTiming, hears_hands_that_take_turns) {
    // Both are carried by the body and swing up and down by turns: added up, how fast they are
    // hardly changes.
    const double delay = 0.12;
    const auto hand = [=](double side) {
        return [=](double beat) {
            return sway(beat - delay) +
                   glm::dvec3(0.0, side * 0.2 * std::sin(M_PI / 2.0 * (beat + 1.0)), 0.0);
        };
    };
    const HandTiming timing = hand_timing(body_of(sway, hand(1.0), hand(-1.0)), kFramesABeat);
    EXPECT_NEAR(timing.delay, delay, 0.05);
    EXPECT_GT(timing.likeness, 0.3);
}

TEST(HandTiming, noise_moves_it_little) {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0.0, 1.0);
        double wander[3][9] = {};
        for (auto& of_joint : wander) {
            for (double& weight : of_joint) {
                weight = 0.02 * normal(random);
            }
        }
        // Slow wander of each joint by itself: 0.15 to 0.85 turns a beat.
        const auto noise = [&](int joint, double beat) {
            glm::dvec3 place(0.0);
            for (int k = 0; k < 9; ++k) {
                place[k % 3] += wander[joint][k] * std::sin((1.0 + 0.5 * k) * beat + k);
            }
            return place;
        };
        const HandTiming timing = hand_timing(
            body_of([&](double beat) { return sway(beat) + 0.3 * noise(0, beat); },
                    [&](double beat) { return 2.0 * sway(beat - 0.1) + noise(1, beat); },
                    [&](double beat) { return 2.0 * sway(beat - 0.1) + noise(2, beat); }),
            kFramesABeat);
        EXPECT_NEAR(timing.delay, 0.1, 0.1) << "seed " << seed;
    }
}

TEST(HandTiming, hands_that_stand_or_go_elsewhere_are_not_alike) {
    const PlaceAt still = [](double) { return glm::dvec3(0.3, 1.0, 0.2); };
    EXPECT_EQ(hand_timing(body_of(sway, still, still), kFramesABeat).likeness, 0.0);
    EXPECT_EQ(hand_timing(body_of(still, sway, sway), kFramesABeat).likeness, 0.0);
    const PlaceAt forward = [](double beat) {
        return glm::dvec3(0.0, 0.0, 0.2 * std::sin(M_PI / 2.0 * beat));
    };
    EXPECT_LT(hand_timing(body_of(sway, forward, forward), kFramesABeat).likeness, 0.01);
}

}  // namespace
}  // namespace raks::motion
