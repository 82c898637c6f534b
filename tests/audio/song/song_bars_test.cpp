#include "audio/song/song_bars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// Seconds at which the bar of this number begins.
double start_of(const KnownPiece& piece, int number) {
    const auto found =
        std::find_if(piece.states.begin(), piece.states.end(), [&](const MusicState& state) {
            return state.ahead.bar == number;
        });
    return found == piece.states.end() ? -1.0 : to_seconds(found->time);
}

// Rock has eight bars of a verse and eight of a chorus in turn, also behind a breakdown.
TEST(SongBars, verse_and_chorus_repeat_their_first_times_behind_a_breakdown) {
    constexpr double kBar = 4.0 * 60.0 / 130.0;
    const KnownPiece piece = piece_of(Style::backbeat, 130.0, 76.0, "full:64,breakdown:32,full:64");
    for (int bar = 1; bar < 16; ++bar) {
        EXPECT_EQ(state_in(piece, 130.0, bar).ahead.repeats[0], -1) << bar;
    }
    const auto expect_repeat = [&](int bar, int before) {
        const Foresight& ahead = state_in(piece, 130.0, bar).ahead;
        ASSERT_GE(ahead.repeats[0], 0) << bar;
        const double back = start_of(piece, ahead.bar) - start_of(piece, ahead.repeats[0]);
        // At the start the tracker may take beat 3 for the downbeat.
        EXPECT_NEAR(back, before * kBar, 0.5 * kBar + 0.1) << bar;
    };
    for (int bar = 26; bar < 31; ++bar) {
        expect_repeat(bar, 16);      // the chorus
        expect_repeat(bar + 8, 32);  // the verse
    }
    // What comes is known three bars ahead.
    const int here = state_in(piece, 130.0, 27).ahead.repeats[0];
    EXPECT_EQ(state_in(piece, 130.0, 25).ahead.repeats[2], here);
    EXPECT_EQ(state_in(piece, 130.0, 24).ahead.repeats[3], here);
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
        MusicPlan plan;
        plan.style = style;
        plan.tempo = {{0.0, usual_tempo(style).bpm()}};
        plan.seconds = 130.0;
        plan.first_beat_seconds = 0.5;
        plan.form = song_form_of(plan);
        const KnownPiece piece = piece_of(plan);
        all += score_repeats(true_bars(piece.music), piece.states);
    }
    EXPECT_GT(all.wanted, 60U);
    EXPECT_GE(all.recall(), 0.75) << all.found << " of " << all.wanted;
    EXPECT_GE(all.precision(), 0.9) << all.right << " of " << all.told;
}

}  // namespace
}  // namespace raks::audio
