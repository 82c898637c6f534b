// The music that the beat network learns from.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "audio/beat/training/drum_scores.hpp"
#include "audio/beat/training/keyboard_scores.hpp"
#include "audio/beat/training/performance.hpp"

namespace raks::audio {
namespace {

template <class Check>
void for_each_variant(std::string_view pattern, const Check& check) {
    while (true) {
        const std::size_t bar = pattern.find('|');
        check(pattern.substr(0, bar));
        if (bar == std::string_view::npos) {
            return;
        }
        pattern.remove_prefix(bar + 1);
    }
}

TEST(TrainingMusic, every_row_of_a_style_fills_its_cell) {
    for (const RhythmStyle& style : rhythm_styles()) {
        const auto steps = static_cast<std::size_t>(style.cell_beats * style.steps_per_beat);
        for (const StyleLane& lane : style.lanes) {
            for_each_variant(lane.pattern, [&](std::string_view row) {
                EXPECT_EQ(steps % row.size(), 0U) << style.name << ": " << row;
                EXPECT_EQ(row.find_first_not_of("Xxo."), std::string_view::npos)
                    << style.name << ": " << row;
            });
        }
        EXPECT_LT(style.lowest_bpm, style.highest_bpm) << style.name;
        EXPECT_EQ(style.cell_beats % style.beats_per_bar, 0) << style.name;
    }
}

TEST(TrainingMusic, drums_stay_on_the_steps_of_their_style) {
    for (const RhythmStyle& style : rhythm_styles()) {
        Dice dice(1, 0);
        const Score score = drum_score(style, 32, dice);
        ASSERT_EQ(score.bar_position.size(), 32U);
        ASSERT_FALSE(score.notes.empty()) << style.name;
        for (const ScoreNote& note : score.notes) {
            EXPECT_GE(note.beat, 0.0);
            EXPECT_LT(note.beat, 32.5);
        }
    }
}

TEST(TrainingMusic, keyboard_pieces_fill_their_beats) {
    for (std::uint64_t number = 0; number < 50; ++number) {
        Dice dice(7, number);
        const Score score = keyboard_score(48, dice);
        ASSERT_EQ(score.bar_position.size(), 48U);
        EXPECT_GT(score.notes.size(), 40U);
        const int metre = *std::max_element(score.bar_position.begin(), score.bar_position.end());
        for (std::size_t beat = 0; beat < score.bar_position.size(); ++beat) {
            EXPECT_EQ(score.bar_position[beat], static_cast<int>(beat) % metre + 1);
        }
        for (const ScoreNote& note : score.notes) {
            EXPECT_GE(note.beat, 0.0);
            EXPECT_GT(note.length, 0.0);
            EXPECT_GE(note.key, 24);
            EXPECT_LE(note.key, 100);
        }
    }
}

TEST(TrainingMusic, a_performance_keeps_its_beats_in_order_and_in_reach) {
    for (std::uint64_t number = 0; number < 50; ++number) {
        Dice dice(9, number);
        const Performance played = perform(keyboard_score(112, dice), 22.0, dice);
        ASSERT_GT(played.beats.size(), 10U);
        for (std::size_t i = 1; i < played.beats.size(); ++i) {
            const double interval = played.beats[i].time - played.beats[i - 1].time;
            EXPECT_GE(interval, 0.25);
            EXPECT_LE(interval, 1.26);
        }
    }
}

}  // namespace
}  // namespace raks::audio
