#include "audio/song/song_bars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "audio/evaluate/repeat_scores.hpp"
#include "audio/song/song_plan.hpp"
#include "tests/audio/listen.hpp"

namespace raks::audio {
namespace {

// A piece in a form, and its states as they are known ahead.
struct KnownPiece {
    GeneratedMusic music;
    std::vector<MusicState> states;
};

KnownPiece piece_of(MusicPlan plan) {
    plan.channels = 1;
    KnownPiece piece{generate(plan).value(), {}};
    SongAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped(piece.music.rate)));
    analyzer.process(piece.music.samples);
    piece.states = analyzer.finish().states;
    return piece;
}

KnownPiece piece_of(Style style, double bpm, double seconds, const std::string& form) {
    return piece_of({.style = style,
                     .tempo = {{0.0, bpm}},
                     .seconds = seconds,
                     .form = parse_form(form).value()});
}

// The state in the middle of a bar at this tempo, in bars of four beats from the start on.
const MusicState& state_in(const KnownPiece& piece, double bpm, int bar) {
    const double seconds = (bar + 0.5) * 4.0 * 60.0 / bpm;
    return piece.states[static_cast<std::size_t>(seconds * kHopsPerSecond)];
}

TEST(SongBars, are_numbered_from_the_first_that_can_be_danced_to) {
    const KnownPiece piece = piece_of(Style::four_on_the_floor, 120.0, 32.0, "full:64");
    const int first = state_in(piece, 120.0, 2).ahead.bar - 2;
    EXPECT_TRUE(first == 0 || first == -1) << first;
    for (int bar = 2; bar < 15; ++bar) {
        EXPECT_EQ(state_in(piece, 120.0, bar).ahead.bar, bar + first);
    }
    EXPECT_EQ(piece.states.front().ahead.repeats[3], -1) << "one loop";
}

TEST(SongBars, after_a_breakdown_the_band_repeats_its_first_time) {
    const KnownPiece piece =
        piece_of(Style::four_on_the_floor, 120.0, 64.0, "full:48,breakdown:32,full:48");
    const int first = state_in(piece, 120.0, 2).ahead.bar - 2;
    for (int bar = 21; bar < 28; ++bar) {
        const Foresight& ahead = state_in(piece, 120.0, bar).ahead;
        EXPECT_EQ(ahead.bar, bar + first);
        EXPECT_GE(ahead.repeats[0], 0) << bar;
        EXPECT_LT(ahead.repeats[0], 12) << bar;
        EXPECT_EQ((ahead.repeats[0] - bar) % 4, first % 4) << "the same chord, in bar " << bar;
    }
    // What comes is known three bars ahead, across the border.
    const Foresight& ahead = state_in(piece, 120.0, 19).ahead;
    EXPECT_EQ(ahead.repeats[0], -1) << "the breakdown is new";
    EXPECT_EQ(ahead.repeats[2], state_in(piece, 120.0, 21).ahead.repeats[0]);
    EXPECT_EQ(ahead.repeats[3], state_in(piece, 120.0, 22).ahead.repeats[0]);
}

// Against the scores that the songs were made from.
TEST(SongBars, parts_of_drawn_songs_that_come_again_are_found) {
    constexpr std::array kStyles{Style::montuno,
                                 Style::maqsum,
                                 Style::four_on_the_floor,
                                 Style::backbeat,
                                 Style::boom_bap,
                                 Style::oom_pah_pah};
    RepeatScore all;
    for (const Style style : kStyles) {
        for (const std::uint64_t seed : {1U, 2U}) {
            MusicPlan plan;
            plan.style = style;
            plan.tempo = {{0.0, usual_tempo(style).bpm()}};
            plan.seconds = 100.0;
            plan.seed = seed;
            plan.form = song_form_of(plan);
            const KnownPiece piece = piece_of(plan);
            const RepeatScore score = score_repeats(true_bars(piece.music), piece.states);
            all += score;
            RecordProperty(std::string(name_of(style)) + std::to_string(seed),
                           std::to_string(score.recall()));
        }
    }
    EXPECT_GT(all.wanted, 100U);
    EXPECT_GE(all.recall(), 0.7);
    EXPECT_GE(all.precision(), 0.9);
}

}  // namespace
}  // namespace raks::audio
