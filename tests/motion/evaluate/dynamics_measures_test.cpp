#include "motion/evaluate/dynamics_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "motion/skeleton/formats/bvh.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

// Joints that all rest but for the left hand, which swings in x.
DynamicsTrack swinging(const std::vector<double>& hand) {
    DynamicsTrack track;
    for (std::size_t b = 0; b < kDynamicsBones.size(); ++b) {
        track.body[b].assign(hand.size(), glm::dvec3(0.1 * static_cast<double>(b), 1.0, 0.0));
        if (kDynamicsBones[b] == Bone::left_hand) {
            for (std::size_t f = 0; f < hand.size(); ++f) {
                track.body[b][f].x += hand[f];
            }
        }
    }
    track.world = track.body;
    return track;
}

// Goes to and fro once a second with 0.3 m to either side, but rests for the frames [from, to).
std::vector<double> swing_with_rest(std::size_t frames, std::size_t from, std::size_t to) {
    std::vector<double> places;
    std::size_t phase = 0;
    for (std::size_t f = 0; f < frames; ++f) {
        phase += f >= from && f < to ? 0 : 1;
        places.push_back(0.3 * std::sin(2.0 * M_PI * static_cast<double>(phase) / 60.0));
    }
    return places;
}

TEST(DynamicsMeasures, of_a_swinging_hand_are_as_arithmetic_says) {
    const DynamicsMeasures measures = measure_dynamics(swinging(swing_with_rest(600, 0, 0)));
    // Mean of |cos| is 2 / pi; one hand of two, one joint of 16.
    const double mean_speed = 0.3 * 2.0 * M_PI * 2.0 / M_PI;
    EXPECT_NEAR(measures.hand_speed, 0.5 * mean_speed, 0.005 * mean_speed);
    EXPECT_NEAR(measures.body_speed, mean_speed / 16.0, 0.005 * mean_speed);
    // Under 0.15 m/s for arcsin(0.15 / 1.885) of a quarter; the other hand always is.
    const double share = std::asin(0.15 / (0.6 * M_PI)) / (0.5 * M_PI);
    EXPECT_NEAR(measures.still_hands, 0.5 * (1.0 + share), 0.01);
    // Slow turns of the swing are shorter than a hold.
    EXPECT_EQ(measures.holds_per_minute, 0.0);
    EXPECT_FALSE(measures.nearest_bar);
}

TEST(PartRepeats, a_bar_is_alike_where_the_body_lies_within_10_cm_of_the_first_time) {
    // The hand goes 2 m aside in the third bar of 2 s: 2 m / sqrt(16 joints) is 50 cm.
    std::vector<double> hand = swing_with_rest(480, 0, 0);
    for (std::size_t f = 240; f < 360; ++f) {
        hand[f] += 2.0;
    }
    const DynamicsTrack track = swinging(hand);
    const std::vector<RepeatedBar> bars = {
        {{2.0, 4.0}, {0.0, 2.0}}, {{4.0, 6.0}, {0.0, 2.0}}, {{6.0, 9.0}, {0.0, 2.0}}};
    const PartRepeats repeats = measure_repeats(track, bars);
    EXPECT_EQ(repeats.bars, 2U) << "the last one does not lie in the track";
    EXPECT_EQ(repeats.alike, 1U);
    EXPECT_NEAR(repeats.apart, 0.25, 0.01) << "between 0 and 50 cm";
    EXPECT_EQ(measure_repeats(track, {}).bars, 0U);
}

TEST(DynamicsMeasures, a_rest_of_half_a_second_is_one_hold) {
    const DynamicsMeasures measures = measure_dynamics(swinging(swing_with_rest(600, 300, 330)));
    EXPECT_NEAR(measures.holds_per_minute, 6.0, 1e-9) << "one in 10 s";
}

TEST(DynamicsMeasures, bars_that_repeat_are_near_and_only_one_is_distinct) {
    BarBeats beats;
    for (int beat = 0; beat < 18; ++beat) {
        beats.times.push_back(0.05 + 0.5 * beat);
    }
    // A swing a second, bars of two seconds: all alike.
    const auto alike = measure_dynamics(swinging(swing_with_rest(600, 0, 0)), beats);
    ASSERT_TRUE(alike.nearest_bar && alike.distinct_bars);
    EXPECT_NEAR(*alike.nearest_bar, 0.0, 1e-9);
    EXPECT_NEAR(*alike.distinct_bars, 0.25, 1e-9) << "one of four bars";
    // From 6 s on the hand is 1 m higher: 1 m of one joint in 16 is 25 cm of the body.
    DynamicsTrack track = swinging(swing_with_rest(600, 0, 0));
    for (std::size_t f = 363; f < 600; ++f) {
        track.body[6][f].y += 1.0;
    }
    const auto apart = measure_dynamics(track, beats);
    EXPECT_NEAR(*apart.distinct_bars, 0.5, 1e-9) << "two of four bars";
}

TEST(DynamicsMeasures, loudness_that_the_body_follows_half_a_second_later_correlates_fully) {
    std::vector<double> loud;
    std::vector<double> speed;
    std::vector<double> against;
    for (int f = 0; f < 1800; ++f) {
        const auto wave = [](int at) { return std::sin(2.0 * M_PI * at / 400.0); };
        loud.push_back(-20.0 + 6.0 * wave(f));
        speed.push_back(0.6 + 0.2 * wave(f - 30));
        against.push_back(0.6 - 0.2 * wave(f));
    }
    EXPECT_NEAR(loudness_correlation(speed, loud), 1.0, 0.001);
    EXPECT_LT(loudness_correlation(against, loud), -0.5);
    EXPECT_EQ(loudness_correlation(std::vector<double>(1800, 0.5), loud), 0.0);
}

// Values of the reference program (numpy) for two takes of people, whole and from 2 to 8 s.
struct ReferenceTake {
    const char* name;
    DanceStretch stretch;
    DynamicsMeasures expected;
};

class ReferenceDynamics : public ::testing::TestWithParam<ReferenceTake> {};
INSTANTIATE_TEST_SUITE_P(
    PlainCuts,
    ReferenceDynamics,
    ::testing::Values(
        ReferenceTake{
            "60_03_973_1679", {}, {0.381, 1.54, 2.393, 0.0, 0.539, 0.02766, 2.379, 0.17894, 1.0}},
        ReferenceTake{
            "60_03_973_1679", {2.0, 8.0}, {0.37, 1.351, 2.291, 0.0, 0.491, 0.04444, 2.426, {}, {}}},
        ReferenceTake{
            "61_03_973_1679", {}, {0.527, 1.36, 2.091, 0.0, 0.581, 0.04752, 2.496, 0.2089, 1.0}},
        ReferenceTake{
            "61_03_973_1679", {2.0, 8.0}, {0.542, 1.4, 2.319, 0.0, 0.6, 0.03333, 2.685, {}, {}}}),
    [](const auto& take) {
        return "take_" + std::string(take.param.name) +
               (take.param.stretch.from > 0.0 ? "_cut" : "_whole");
    });

TEST_P(ReferenceDynamics, equal_those_of_the_reference_program) {
    const fs::path file =
        raks::test::shared_data() / "mocap" / "salsa" / (std::string(GetParam().name) + ".bvh");
    if (!fs::exists(file)) {
        GTEST_SKIP() << "no clip at " << file;
    }
    const auto clip = read_bvh(file, {.frames_per_second = 60.0});
    ASSERT_TRUE(clip) << clip.error().message;
    const auto track = dynamics_track(*clip, GetParam().stretch);
    ASSERT_TRUE(track) << track.error().message;
    BarBeats beats;
    for (int beat = 1; beat <= 23; ++beat) {
        beats.times.push_back(0.1 + 0.5 * beat);
    }
    const DynamicsMeasures is = measure_dynamics(*track, beats);
    const DynamicsMeasures& wanted = GetParam().expected;
    // The reference is printed with three decimals.
    const auto near = [](double value, double reference, const char* what) {
        EXPECT_NEAR(value, reference, 0.003 * std::abs(reference) + 0.0006) << what;
    };
    near(is.body_speed, wanted.body_speed, "body speed");
    near(is.second_spread, wanted.second_spread, "spread of 1 s");
    near(is.body_spread, wanted.body_spread, "spread of body speed");
    near(is.holds_per_minute, wanted.holds_per_minute, "holds");
    near(is.hand_speed, wanted.hand_speed, "hand speed");
    near(is.still_hands, wanted.still_hands, "still hands");
    near(is.hand_hits, wanted.hand_hits, "hits");
    if (wanted.nearest_bar) {
        near(is.nearest_bar.value_or(0.0), *wanted.nearest_bar, "nearest bar");
        near(is.distinct_bars.value_or(0.0), *wanted.distinct_bars, "distinct bars");
    }
}

}  // namespace
}  // namespace raks::motion
