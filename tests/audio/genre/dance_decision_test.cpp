#include "audio/genre/dance_decision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::audio {
namespace {

constexpr std::size_t kDecidedClasses = 3;
constexpr std::size_t kNoDance = 2;
constexpr ClassBars kDecidedBars = {4, 3, 0};

DanceDecision::Values logs_of_chances(const std::array<float, kDecidedClasses>& chances) {
    DanceDecision::Values logs{};
    for (std::size_t c = 0; c < kDecidedClasses; ++c) {
        logs[c] = std::log(chances[c]);
    }
    return logs;
}

BeatGrid sure_grid(int beats_per_bar) {
    BeatGrid grid;
    grid.confidence = 1.0F;
    grid.bar_confidence = 1.0F;
    grid.beats_per_bar = beats_per_bar;
    return grid;
}

TEST(DanceDecision, nothing_heard_is_none_or_what_was_told) {
    EXPECT_EQ(DanceDecision(kDecidedClasses, kDecidedBars, {}).shown(), kNoDance);
    const DanceDecision told(kDecidedClasses, kDecidedBars, {0.0F, 1.5F});
    EXPECT_EQ(told.shown(), 1U);
    EXPECT_TRUE(told.is_told());
}

TEST(DanceDecision, another_class_must_lead_for_half_a_second) {
    DanceDecision decision(kDecidedClasses, kDecidedBars, {});
    const auto first = logs_of_chances({0.8F, 0.1F, 0.1F});
    for (int i = 0; i < 4; ++i) {
        decision.advance(first, 0, sure_grid(4));
    }
    EXPECT_EQ(decision.shown(), kNoDance);
    decision.advance(first, 0, sure_grid(4));
    EXPECT_EQ(decision.shown(), 0U);
    decision.advance(logs_of_chances({0.1F, 0.8F, 0.1F}), 0, sure_grid(4));
    EXPECT_EQ(decision.shown(), 0U);
}

TEST(DanceDecision, a_whole_song_is_settled_at_once) {
    DanceDecision decision(kDecidedClasses, kDecidedBars, {});
    decision.settle(logs_of_chances({0.8F, 0.1F, 0.1F}), 3'000, sure_grid(4));
    EXPECT_EQ(decision.shown(), 0U);
    decision.settle(logs_of_chances({0.35F, 0.33F, 0.32F}), 3'000, BeatGrid());
    EXPECT_EQ(decision.shown(), kNoDance) << "not likely enough";
}

TEST(DanceDecision, bars_of_another_metre_take_the_prior_away) {
    DanceDecision decision(kDecidedClasses, kDecidedBars, {0.0F, 1.5F});
    const auto heard = logs_of_chances({0.5F, 0.3F, 0.2F});
    decision.settle(heard, 3'000, sure_grid(3));
    EXPECT_EQ(decision.shown(), 1U);
    EXPECT_TRUE(decision.is_told());
    decision.settle(heard, 3'000, sure_grid(4));
    EXPECT_EQ(decision.shown(), 0U);
    EXPECT_FALSE(decision.is_told());
}

TEST(DanceDecision, another_prior_counts_at_once_and_what_was_heard_stays) {
    DanceDecision decision(kDecidedClasses, kDecidedBars, {});
    decision.expect({0.0F, 1.5F});
    EXPECT_EQ(decision.shown(), 1U);
    EXPECT_TRUE(decision.is_told());
    for (int i = 0; i < 10; ++i) {
        decision.advance(logs_of_chances({0.9F, 0.05F, 0.05F}), 0, sure_grid(4));
    }
    EXPECT_EQ(decision.shown(), 0U);
    decision.expect({0.0F, 1.0F});
    EXPECT_EQ(decision.shown(), 0U) << "it is heard";
    decision.reset();
    EXPECT_EQ(decision.shown(), 1U);
}

}  // namespace
}  // namespace raks::audio
