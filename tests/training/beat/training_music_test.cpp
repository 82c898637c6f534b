// The music that the beat network learns from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "audio/music/instruments/studio.hpp"
#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/keyboard_scores.hpp"
#include "audio/music/score/score.hpp"
#include "tests/audio/music/shipped_styles.hpp"

namespace raks::audio {
namespace {

TEST(TrainingMusic, drums_stay_on_the_steps_of_their_style) {
    for (const RhythmStyle& style : shipped_styles().rhythms) {
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

const RhythmStyle& style_named(std::string_view name) {
    const std::vector<RhythmStyle>& styles = shipped_styles().rhythms;
    return *std::find_if(
        styles.begin(), styles.end(), [&](const RhythmStyle& style) { return style.name == name; });
}

/// Where in the beats, counted from the first one, something sounds.
double beat_at(double time, const std::vector<PlayedBeat>& beats) {
    std::size_t after = 1;
    while (after + 1 < beats.size() && beats[after].time <= time) {
        ++after;
    }
    const double begin = beats[after - 1].time;
    return static_cast<double>(after - 1) + (time - begin) / (beats[after].time - begin);
}

TEST(TrainingMusic, machines_play_exactly_on_their_grid) {
    for (std::uint64_t number = 0; number < 40; ++number) {
        Dice dice(11, number);
        Score score = drum_score(style_named("house"), 64, dice);
        for (ScoreNote& note : score.notes) {
            note.beat = std::round(4.0 * note.beat) / 4.0;  // no swing
        }
        give_to_machines(score, dice);
        const Performance played = perform(score, 22.0, dice);
        ASSERT_FALSE(played.notes.empty());
        const auto is_off_grid = [&](const PlayedNote& note) {
            const double eighths = 8.0 * beat_at(note.time, played.beats);
            return note.time < played.beats.back().time &&
                   std::abs(eighths - std::round(eighths)) > 1e-6;
        };
        // Ghost notes (6 % at most) follow the nominal tempo.
        EXPECT_LT(std::count_if(played.notes.begin(), played.notes.end(), is_off_grid),
                  0.12 * static_cast<double>(played.notes.size()))
            << number;
    }
}

TEST(TrainingMusic, parts_of_machines_come_and_go_and_some_part_always_plays) {
    int pieces_with_pauses = 0;
    for (std::uint64_t number = 0; number < 60; ++number) {
        Dice dice(12, number);
        Score score = drum_score(style_named("techno"), 64, dice);
        const auto bass_drums = [&score] {
            std::array<int, 9> in_phrase{};  // the last: a fill's end
            for (const ScoreNote& note : score.notes) {
                in_phrase.at(static_cast<std::size_t>(note.beat / 8.0)) += note.key == 36 ? 1 : 0;
            }
            return in_phrase;
        };
        const auto written = bass_drums();
        give_to_machines(score, dice);
        const auto left = bass_drums();
        pieces_with_pauses += written != left ? 1 : 0;
        for (std::size_t phrase = 0; phrase < 8; ++phrase) {
            EXPECT_TRUE(left.at(phrase) == written.at(phrase) || left.at(phrase) == 0);
            const auto sounds = [phrase](const ScoreNote& note) {
                return static_cast<std::size_t>(note.beat / 8.0) == phrase;
            };
            EXPECT_TRUE(std::any_of(score.notes.begin(), score.notes.end(), sounds)) << number;
        }
    }
    EXPECT_GT(pieces_with_pauses, 15);
    EXPECT_LT(pieces_with_pauses, 45);
}

TEST(TrainingMusic, a_pumping_compressor_dips_behind_each_drum_and_recovers) {
    constexpr int kRate = 1000;
    std::vector<float> samples(2000, 1.0F);
    pump(std::array{0.5, 1.0}, 0.8, 0.2, kRate, samples);
    const auto level_at = [&](double seconds) {
        return samples[static_cast<std::size_t>(std::lround(seconds * kRate))];
    };
    EXPECT_FLOAT_EQ(level_at(0.0), 1.0F);
    EXPECT_FLOAT_EQ(level_at(0.5), 1.0F) << "the drum gets through";
    EXPECT_NEAR(level_at(0.515), 0.2F, 1e-4);
    EXPECT_NEAR(level_at(0.615), 0.6F, 1e-4) << "half of the way back";
    EXPECT_FLOAT_EQ(level_at(0.72), 1.0F);
    EXPECT_NEAR(level_at(1.015), 0.2F, 1e-4);
    EXPECT_FLOAT_EQ(level_at(1.9), 1.0F);
}

}  // namespace
}  // namespace raks::audio
