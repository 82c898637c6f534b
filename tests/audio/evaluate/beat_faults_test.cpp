#include "audio/evaluate/beat_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace raks::audio {
namespace {

/// Beats every half second.
std::vector<double> steady(int beats, double first = 0.0, double period = 0.5) {
    std::vector<double> times(static_cast<std::size_t>(beats));
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = first + period * static_cast<double>(i);
    }
    return times;
}

TEST(OtherPulse, lies_between_the_beats) {
    const std::vector<double> uneven = {0.0, 1.0, 3.0, 4.0};
    EXPECT_EQ(other_pulse(uneven, 2.0, 0.0), (std::vector<double>{0.0, 0.5, 1.0, 2.0, 3.0, 3.5}));
    EXPECT_EQ(other_pulse(uneven, 1.0, 0.5), (std::vector<double>{0.5, 2.0, 3.5}));
    EXPECT_EQ(other_pulse(uneven, 0.5, 1.0), (std::vector<double>{1.0}));
    EXPECT_TRUE(other_pulse(std::vector<double>{1.0}, 2.0, 0.0).empty());
    EXPECT_TRUE(other_pulse({}, 2.0, 0.0).empty());
}

TEST(BeatFault, each_kind_is_told_from_the_others) {
    const std::vector<double> beats = steady(60);
    const auto kinds = [&](const std::vector<double>& estimate) {
        const BeatFault fault = fault_of(beats, estimate);
        return std::array{
            fault.is_octave, fault.is_three_two, fault.is_off_beat, fault.is_third_off};
    };
    EXPECT_EQ(kinds(beats), (std::array{false, false, false, false}));
    EXPECT_EQ(kinds(steady(120, 0.0, 0.25)), (std::array{true, false, false, false}));
    EXPECT_EQ(kinds(steady(30, 0.5, 1.0)), (std::array{true, false, false, false}));
    EXPECT_EQ(kinds(steady(89, 0.0, 1.0 / 3.0)), (std::array{false, true, false, false}));
    EXPECT_EQ(kinds(steady(39, 0.25, 0.75)), (std::array{false, true, false, false}));
    EXPECT_EQ(kinds(steady(59, 0.25)), (std::array{false, false, true, false}));
    EXPECT_EQ(kinds(steady(59, 1.0 / 3.0)), (std::array{false, false, false, true}));
    EXPECT_EQ(kinds(steady(37, 0.1, 0.8)), (std::array{false, false, false, false}));
    EXPECT_EQ(kinds({}), (std::array{false, false, false, false}));
}

TEST(BeatClaims, a_beat_counts_for_one_claim_and_what_is_not_annotated_for_none) {
    const std::vector<double> beats = steady(4, 10.0);
    const std::vector<double> said = {9.0, 10.01, 10.03, 10.49, 10.8, 11.55, 13.0};
    const std::vector<float> sure = {0.9F, 0.8F, 0.7F, 0.6F, 0.5F, 0.4F, 0.3F};
    const std::vector<Claim> claims = beat_claims(beats, said, sure);
    ASSERT_EQ(claims.size(), 5U);
    const std::vector<bool> right = {true, false, true, false, true};
    for (std::size_t i = 0; i < claims.size(); ++i) {
        EXPECT_EQ(claims[i].is_right, right[i]) << i;
        EXPECT_FLOAT_EQ(claims[i].confidence, sure[i + 1]);
    }
    const std::vector<int> places = {1, 2, 3, 4};
    const std::vector<int> told = {1, 1, 2, 2, 3, 1, 1};
    const std::vector<Claim> bars = bar_claims(beats, places, said, told, sure);
    ASSERT_EQ(bars.size(), 3U);
    EXPECT_TRUE(bars[0].is_right);
    EXPECT_TRUE(bars[1].is_right);
    EXPECT_FALSE(bars[2].is_right);
    EXPECT_TRUE(bar_claims(beats, {}, said, told, sure).empty());
}

}  // namespace
}  // namespace raks::audio
