#include "audio/beat/bar_tracker.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Onset strength of the low, middle and high band on one half beat of the bar.
using Slot = std::array<float, kOnsetBands>;
using Bar = std::array<Slot, BarTracker::kSlots>;

constexpr Slot kBassDrum{1.0F, 0.3F, 0.2F};
constexpr Slot kSnare{0.1F, 1.0F, 0.3F};
constexpr Slot kHat{0.0F, 0.0F, 0.3F};

/// Bass drum on 1 and, softer, on 3; snare on 2 and 4; hats between.
constexpr Bar kRock{{kBassDrum, kHat, kSnare, kHat, {0.7F, 0.2F, 0.2F}, kHat, kSnare, kHat}};
/// Tumbao on 2+ and 4, congas on 4 and 4+, bell on 1 and 3.
constexpr Bar kSalsa{{{0.0F, 0.2F, 0.6F},
                      {0.0F, 0.0F, 0.0F},
                      {0.0F, 0.5F, 0.1F},
                      {1.0F, 0.2F, 0.0F},
                      {0.1F, 0.2F, 0.6F},
                      {0.0F, 0.0F, 0.0F},
                      {1.0F, 0.6F, 0.1F},
                      {0.2F, 0.6F, 0.0F}}};

/// Plays `bars` bars into the tracker, each half beat one hop among empty ones; beat `first` of the
/// grid is the bar's 1. The first advice that is not keep, if any.
GridAdvice play(BarTracker& tracker, const Bar& bar, int first, int bars, double bpm = 120.0) {
    constexpr int kHopsPerHalfBeat = 20;
    GridAdvice told = GridAdvice::keep;
    for (int hop = 0; hop < bars * BarTracker::kSlots * kHopsPerHalfBeat; ++hop) {
        Onset onset;
        if (hop % kHopsPerHalfBeat == 0) {
            const int slot = hop / kHopsPerHalfBeat - 2 * first + 4 * BarTracker::kSlots;
            onset.flux = bar[static_cast<std::size_t>(slot % BarTracker::kSlots)];
        }
        const double position = static_cast<double>(hop) / (2.0 * kHopsPerHalfBeat);
        const GridAdvice advice = tracker.add(onset, position, bpm);
        told = told == GridAdvice::keep ? advice : told;
    }
    return told;
}

TEST(BarTracker, finds_the_downbeat_of_rock_and_salsa_in_every_rotation) {
    for (const Bar& bar : {kRock, kSalsa}) {
        for (int first = 0; first < BarTracker::kBeatsPerBar; ++first) {
            BarTracker tracker;
            EXPECT_EQ(play(tracker, bar, first, 12), GridAdvice::keep) << first;
            EXPECT_EQ(tracker.origin(), first);
            EXPECT_GT(tracker.confidence(), 0.0F) << first;
            EXPECT_LE(tracker.confidence(), 1.0F) << first;
        }
    }
}

TEST(BarTracker, knows_nothing_before_it_hears_and_in_even_beats) {
    BarTracker tracker;
    EXPECT_EQ(tracker.origin(), 0);
    EXPECT_EQ(tracker.confidence(), 0.0F);
    constexpr Bar kEven{{kBassDrum, kHat, kBassDrum, kHat, kBassDrum, kHat, kBassDrum, kHat}};
    play(tracker, kEven, 0, 12);
    EXPECT_LT(tracker.confidence(), 0.15F) << "no beat is like a 1";
}

TEST(BarTracker, one_odd_bar_does_not_move_the_downbeat) {
    BarTracker tracker;
    play(tracker, kRock, 0, 12);
    play(tracker, kRock, 1, 1);
    EXPECT_EQ(tracker.origin(), 0);
}

TEST(BarTracker, follows_a_downbeat_that_has_moved_for_good) {
    BarTracker tracker;
    play(tracker, kRock, 0, 8);
    play(tracker, kRock, 1, 24);
    EXPECT_EQ(tracker.origin(), 1);
}

TEST(BarTracker, what_the_user_says_is_held_until_reset) {
    BarTracker tracker;
    tracker.hold(-2);
    EXPECT_EQ(tracker.origin(), 2) << "beat -2 is two before beat 0";
    EXPECT_EQ(tracker.confidence(), 1.0F);
    play(tracker, kRock, 1, 12);
    EXPECT_EQ(tracker.origin(), 2);
    tracker.reset();
    play(tracker, kRock, 1, 12);
    EXPECT_EQ(tracker.origin(), 1);
}

TEST(BarTracker, a_grid_twice_too_fast_is_told_with_the_beats_that_are_left) {
    constexpr Bar kEveryOther{{kBassDrum, {}, kHat, {}, kSnare, {}, kHat, {}}};
    BarTracker tracker;
    EXPECT_EQ(play(tracker, kEveryOther, 0, 12, 180.0), GridAdvice::halve);
    tracker.reset();
    EXPECT_EQ(play(tracker, kEveryOther, 1, 12, 180.0), GridAdvice::halve_other);
    tracker.reset();
    EXPECT_EQ(play(tracker, kEveryOther, 0, 12, 90.0), GridAdvice::keep) << "90 is no fast grid";
}

TEST(BarTracker, a_grid_twice_too_slow_is_told) {
    constexpr Slot kSnareAsStrong{0.2F, 1.1F, 0.3F};
    constexpr Bar kOnAllHalves{{kBassDrum,
                                kSnareAsStrong,
                                kBassDrum,
                                kSnareAsStrong,
                                kBassDrum,
                                kSnareAsStrong,
                                kBassDrum,
                                kSnareAsStrong}};
    BarTracker tracker;
    EXPECT_EQ(play(tracker, kOnAllHalves, 0, 12, 64.0), GridAdvice::double_up);
    tracker.reset();
    EXPECT_NE(play(tracker, kOnAllHalves, 0, 12, 128.0), GridAdvice::double_up);
}

TEST(BarTracker, keeps_the_real_time_rules) {
    BarTracker tracker;
    test::RealtimeScope scope;
    const GridAdvice advice = play(tracker, kSalsa, 2, 40);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(advice, GridAdvice::keep);
}

}  // namespace
}  // namespace raks::audio
