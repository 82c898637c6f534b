#include "audio/music/score/metre_variations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace raks::audio {
namespace {

double part_in_beat(double beat) { return beat - std::floor(beat); }

/// 32 beats of kick, snare and hats in eighths, with a bass in sixteenths.
Score straight_score() {
    Score score;
    for (int beat = 0; beat < 32; ++beat) {
        score.bar_position.push_back(beat % 4 + 1);
        score.notes.push_back({double(beat), 0.2, kDrumChannel, beat % 2 == 0 ? 36 : 38, 0, 100.0});
        score.notes.push_back({double(beat), 0.2, kDrumChannel, 42, 0, 70.0});
        score.notes.push_back({beat + 0.5, 0.2, kDrumChannel, 42, 0, 70.0});
        for (int step = 0; step < 4; ++step) {
            score.notes.push_back({beat + 0.25 * step, 0.2, 0, 40, 33, 90.0});
        }
    }
    return score;
}

TEST(MetreVariations, a_compound_twin_has_its_notes_on_thirds) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        Score score = straight_score();
        EXPECT_EQ(parts_of(score), 2);
        Dice dice(seed, 1);
        make_compound(score, dice);
        EXPECT_EQ(parts_of(score), 3) << seed;
        EXPECT_EQ(score.bar_position.size(), 32U);
        for (const ScoreNote& note : score.notes) {
            const double thirds = 3.0 * note.beat;
            EXPECT_NEAR(thirds, std::round(thirds), 1e-6) << seed;
        }
        EXPECT_GE(score.lowest_bpm, 40.0);
        EXPECT_LE(score.highest_bpm, 160.0);
    }
}

TEST(MetreVariations, triplet_hats_leave_the_other_players_straight) {
    Score score = straight_score();
    Dice dice(3, 1);
    add_triplet_hats(score, dice);
    for (const ScoreNote& note : score.notes) {
        if (note.channel != kDrumChannel || note.key == 36 || note.key == 38) {
            const double quarters = 4.0 * note.beat;
            EXPECT_NEAR(quarters, std::round(quarters), 1e-9);
        }
    }
}

TEST(MetreVariations, an_additive_bar_has_groups_of_two_and_three) {
    std::set<std::size_t> bars;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Dice dice(seed, 1);
        const Score score = additive_score(60, dice);
        ASSERT_EQ(score.bar_position.size(), score.beat_parts.size());
        std::vector<std::size_t> downbeats;
        for (std::size_t i = 0; i < score.bar_position.size(); ++i) {
            if (score.bar_position[i] == 1) {
                downbeats.push_back(i);
            }
            if (score.bar_position[i] == Score::kNoBeat) {
                continue;
            }
            // The next beat comes after as many eighths as the beat has parts.
            const auto next = static_cast<std::size_t>(score.beat_parts[i]);
            ASSERT_TRUE(next == 2 || next == 3);
            for (std::size_t k = 1; k < next; ++k) {
                EXPECT_EQ(score.bar_position[i + k], Score::kNoBeat);
            }
        }
        bars.insert(downbeats[1] - downbeats[0]);
        // Every group begins with a sound that most bars have.
        Performance played = perform(score, 10.0, dice);
        EXPECT_GE(played.beats.size(), 10U);
        for (const PlayedBeat& beat : played.beats) {
            EXPECT_GT(beat.bar_position, 0);
        }
    }
    EXPECT_TRUE(bars.contains(5) && bars.contains(7) && bars.contains(9));
}

TEST(MetreVariations, claps_of_an_audience_scatter_around_its_beats) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Score score = straight_score();
        Dice dice(seed, 1);
        add_claps(score, dice);
        int claps = 0;
        for (const ScoreNote& note : score.notes) {
            if (note.channel == kDrumChannel && note.key == 39) {
                const double off = part_in_beat(note.beat + 0.5) - 0.5;
                EXPECT_LT(std::abs(off), 0.25) << seed;
                ++claps;
            }
        }
        EXPECT_GE(claps, 16) << seed;
    }
}

TEST(MetreVariations, a_slow_score_is_played_slowly) {
    Score score = straight_score();
    Dice dice(5, 1);
    slow_down(score, dice);
    const Performance played = perform(score, 20.0, dice);
    for (std::size_t i = 1; i < played.beats.size(); ++i) {
        EXPECT_GT(played.beats[i].time - played.beats[i - 1].time, 0.7);
    }
}

}  // namespace
}  // namespace raks::audio
