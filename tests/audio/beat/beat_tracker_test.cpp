// The tracker as its users meet it: through the analyzer, on music with known beats.
#include "audio/beat/beat_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "tests/audio/listen.hpp"

namespace raks::audio {
namespace {

using test::BeatScore;
using test::listen;
using test::music;
using test::score_beats;

TEST(BeatTracker, holds_steady_tempi_from_60_to_200_bpm) {
    for (const Style style : {Style::clicks, Style::drums}) {
        for (const double bpm : {60.0, 75.0, 90.0, 110.0, 120.0, 140.0, 160.0, 180.0, 200.0}) {
            const GeneratedMusic piece = music(style, {{0.0, bpm}}, 24.0);
            const auto states = listen(piece);
            // Eighths at 60 are beats at 120 as well: the slower octave wins after 13 s.
            const double settled = bpm < 65.0 ? 13.3 : 10.3;
            const BeatScore score = score_beats(states, piece.beats, settled, 23.7);
            EXPECT_GE(score.f_measure, 0.97) << name_of(style) << " at " << bpm;
            EXPECT_LE(std::abs(score.median_error), std::max(0.012, 0.93 / bpm))
                << name_of(style) << " at " << bpm;
            EXPECT_NEAR(states.back().grid.tempo.bpm(), bpm, 0.01 * bpm) << name_of(style);
        }
    }
}

TEST(BeatTracker, follows_the_dances_at_their_tempi) {
    const struct {
        Style style;
        double bpm;
    } cases[] = {{Style::montuno, 165.0}, {Style::montuno, 184.0}, {Style::montuno, 205.0}};
    for (const auto& c : cases) {
        const GeneratedMusic piece = music(c.style, {{0.0, c.bpm}}, 30.0);
        const BeatScore score = score_beats(listen(piece), piece.beats, 14.0, 29.9);
        EXPECT_GE(score.f_measure, 0.95) << name_of(c.style) << " at " << c.bpm;
    }
}

TEST(BeatTracker, follows_ramps_of_2_percent_a_second) {
    for (const auto& [from, to] : {std::pair{110.0, 160.0}, std::pair{160.0, 110.0}}) {
        const double seconds = std::abs(std::log(to / from)) / 0.02;
        const GeneratedMusic piece =
            music(Style::drums, {{0.0, from}, {8.0, from}, {8.0 + seconds, to}}, 12.0 + seconds);
        const BeatScore score = score_beats(listen(piece), piece.beats, 6.0, 11.9 + seconds);
        EXPECT_GE(score.f_measure, 0.95) << from << " to " << to;
        EXPECT_LE(score.worst_error, 0.06) << from << " to " << to;
    }
}

TEST(BeatTracker, tempo_jump_from_90_to_140_locks_within_4_seconds) {
    const GeneratedMusic piece =
        music(Style::drums, {{0.0, 90.0}, {15.0, 90.0}, {15.0, 140.0}}, 30.0);
    const BeatScore score = score_beats(listen(piece), piece.beats, 19.0, 29.9);
    EXPECT_GE(score.f_measure, 0.95);
}

TEST(BeatTracker, announces_nothing_in_digital_silence_or_faint_noise) {
    const CounterRandom random(4);
    for (const float level : {0.0F, 0.0005F}) {
        GeneratedMusic piece;
        piece.channels = 1;
        piece.samples.resize(30 * 48'000);
        for (std::size_t i = 0; i < piece.samples.size(); ++i) {
            piece.samples[i] = level * static_cast<float>(random.normal(i));
        }
        int beats = 0;
        for (const MusicState& state : listen(piece)) {
            beats += state.has_beat ? 1 : 0;
            EXPECT_LT(state.grid.confidence, 0.3F);
        }
        EXPECT_EQ(beats, 0) << level;
    }
}

TEST(BeatTracker, confidence_rises_with_the_music_and_falls_in_silence) {
    MusicPlan plan;
    plan.style = Style::drums;
    plan.tempo = {{0.0, 120.0}};
    plan.seconds = 30.0;
    plan.channels = 1;
    plan.silences = {{15.0, 25.0}};
    const auto piece = generate(plan);
    ASSERT_TRUE(piece);
    const auto states = listen(*piece);
    EXPECT_GT(states[1400].grid.confidence, 0.5F);
    EXPECT_FALSE(states[1400].is_silent);
    EXPECT_LT(states[2000].grid.confidence, 0.1F);
    EXPECT_TRUE(states[2000].is_silent);
    EXPECT_GT(states[2900].grid.confidence, 0.4F);
}

TEST(BeatTracker, the_grid_is_continuous_and_its_tempo_calm_on_steady_music) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 184.0}}, 30.0);
    const auto states = listen(piece);
    for (std::size_t hop = 1500; hop < states.size(); ++hop) {
        const BeatGrid& before = states[hop - 1].grid;
        const BeatGrid& now = states[hop].grid;
        const StreamTime time = states[hop].time;
        EXPECT_NEAR((now.beats_at(time) - before.beats_at(time)).count(), 0.0, 0.01) << hop;
        EXPECT_NEAR(now.tempo.bpm(), 184.0, 4.0) << hop;
    }
}

TEST(BeatTracker, predicted_beats_come_100_ms_ahead_and_are_right) {
    const GeneratedMusic piece = music(Style::drums, {{0.0, 128.0}}, 25.0);
    int predicted = 0;
    int hits = 0;
    for (const MusicState& state : listen(piece)) {
        const double time = to_seconds(state.predicted);
        if (!state.has_predicted || time < 8.0 || time > 24.5) {
            continue;
        }
        ++predicted;
        EXPECT_NEAR(to_seconds(state.predicted - state.audio_end), 0.095, 0.006);
        for (const ReferenceBeat& beat : piece.beats) {
            hits += std::abs(to_seconds(beat.time) - time) < 0.035 ? 1 : 0;
        }
    }
    EXPECT_GE(predicted, 34);
    EXPECT_GE(hits, predicted * 95 / 100);
}

class Commanded : public ::testing::Test {
 protected:
    /// Tempo of the grid at the end of 20 s of drums at 100 BPM with one command at 10 s.
    static std::vector<MusicState> after(AnalyzerCommand::Kind kind, double value = 0.0) {
        const GeneratedMusic piece = music(Style::drums, {{0.0, 100.0}}, 20.0);
        MusicAnalyzer analyzer;
        EXPECT_TRUE(analyzer.prepare(test::as_shipped(piece.rate)));
        analyzer.command({kind, stream_time_from_seconds(10.0), value});
        test::Collect collect;
        analyzer.process(piece.mono(), collect);
        return collect.states;
    }
};

TEST_F(Commanded, half_and_double_tempo_hold) {
    EXPECT_NEAR(after(AnalyzerCommand::Kind::half_tempo).back().grid.tempo.bpm(), 50.0, 1.5);
    EXPECT_NEAR(after(AnalyzerCommand::Kind::double_tempo).back().grid.tempo.bpm(), 200.0, 4.0);
}

// The music has no such beat here, so it is left again later.
TEST_F(Commanded, three_for_two_takes_what_the_music_fits_better) {
    const double bpm = after(AnalyzerCommand::Kind::three_two)[1050].grid.tempo.bpm();
    EXPECT_TRUE(std::abs(bpm - 150.0) < 4.0 || std::abs(bpm - 200.0 / 3.0) < 2.0) << bpm;
}

TEST_F(Commanded, a_set_tempo_is_kept_whatever_the_music_does) {
    const auto states = after(AnalyzerCommand::Kind::set_tempo, 137.0);
    EXPECT_NEAR(states.back().grid.tempo.bpm(), 137.0, 1e-6);
    EXPECT_NEAR(states[900].grid.tempo.bpm(), 100.0, 1.0) << "before the command's time";
}

TEST_F(Commanded, resync_makes_the_nearest_beat_count_one) {
    // Beat 17 at 100 BPM falls at 10.2 s: the nearest to 10 s.
    const auto states = after(AnalyzerCommand::Kind::resync_bar);
    const BeatGrid& grid = states.back().grid;
    const double bar =
        grid.bar_position(Beats(std::round(grid.beats_at(stream_time_from_seconds(10.2)).count())));
    EXPECT_NEAR(bar, 0.0, 1e-6);
}

TEST_F(Commanded, nudge_moves_the_beats) {
    const auto plain = after(AnalyzerCommand::Kind::release_tempo);
    const auto moved = after(AnalyzerCommand::Kind::nudge, 0.05);
    const StreamTime end = plain.back().time;
    const double beats =
        (moved.back().grid.beats_at(end) - plain.back().grid.beats_at(end)).count();
    EXPECT_NEAR((beats - std::round(beats)) * 0.6, -0.05, 0.012) << "seconds";
}

TEST_F(Commanded, beats_that_are_set_stay_where_they_are_whatever_the_music_does) {
    // The music has its beats at 9.6 and 10.2 s: this one is between them.
    const auto states = after(AnalyzerCommand::Kind::set_beat);
    for (std::size_t hop = 1001; hop < states.size(); hop += 50) {
        const double phase =
            BeatPhase(states[hop].grid.beats_at(stream_time_from_seconds(10.0))).value();
        const double rate = states[hop].grid.tempo.bpm() / states[1001].grid.tempo.bpm();
        EXPECT_NEAR(phase - std::round(phase), 0.0, 1e-6) << hop;
        EXPECT_EQ(rate, 1.0) << hop;
        EXPECT_TRUE(states[hop].is_tempo_held);
    }
}

TEST_F(Commanded, taps_set_tempo_and_phase_without_music) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    for (int tap = 0; tap < 6; ++tap) {
        analyzer.command(
            {AnalyzerCommand::Kind::tap, stream_time_from_seconds(2.0 + 0.4 * tap), 0.0});
    }
    test::Collect collect;
    analyzer.process(std::vector<float>(48'000 * 5), collect);
    const BeatGrid& grid = collect.states.back().grid;
    EXPECT_NEAR(grid.tempo.bpm(), 150.0, 1.0);
    const double phase = BeatPhase(grid.beats_at(stream_time_from_seconds(4.0))).value();
    EXPECT_NEAR(phase - std::round(phase), 0.0, 0.03);
}

}  // namespace
}  // namespace raks::audio
