// What a dancer needs of the tracker on a stage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/audio/beatless_sound.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

using test::Collect;
using test::listen;
using test::music;

constexpr int kRate = 48'000;

std::vector<MusicState> listen_to(const std::vector<float>& mono) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped(SampleRate(kRate))));
    Collect collect;
    analyzer.process(mono, collect);
    return collect.states;
}

int announced(const std::vector<MusicState>& states, float above = 0.0F) {
    return static_cast<int>(std::count_if(states.begin(), states.end(), [above](const auto& state) {
        return state.has_beat && state.beat.confidence > above;
    }));
}

/// Seconds from the first reference beat after `from` to the first of 4 beats in a row that are all
/// announced within 70 ms, with none between.
double seconds_to_lock(const std::vector<MusicState>& states,
                       const std::vector<ReferenceBeat>& beats,
                       double from) {
    std::vector<double> reference;
    for (const ReferenceBeat& beat : beats) {
        if (to_seconds(beat.time) >= from) {
            reference.push_back(to_seconds(beat.time));
        }
    }
    for (std::size_t first = 0; first + 4 <= reference.size(); ++first) {
        const double begin = reference[first] - 0.07;
        const double end = reference[first + 3] + 0.07;
        const auto count = std::count_if(states.begin(), states.end(), [&](const auto& state) {
            const double time = to_seconds(state.beat.time);
            return state.has_beat && time >= begin && time <= end;
        });
        const bool are_hit = std::all_of(
            reference.begin() + static_cast<std::ptrdiff_t>(first),
            reference.begin() + static_cast<std::ptrdiff_t>(first) + 4,
            [&](double beat) {
                return std::any_of(states.begin(), states.end(), [beat](const auto& state) {
                    return state.has_beat && std::abs(to_seconds(state.beat.time) - beat) <= 0.07;
                });
            });
        if (count == 4 && are_hit) {
            return reference[first] - reference.front();
        }
    }
    return 1e9;
}

/// How far the grid's nearest beat lies from a moment, seconds.
double distance_to_beat(const BeatGrid& grid, StreamTime moment) {
    const double phase = grid.beats_at(moment).count();
    return std::abs(phase - std::round(phase)) * grid.tempo.seconds_per_beat();
}

TEST(Stage, locks_in_about_a_bar) {
    std::vector<double> bars;
    for (const auto& [style, bpm] : {std::pair{Style::drums, 90.0},
                                     std::pair{Style::drums, 125.0},
                                     std::pair{Style::drums, 165.0},
                                     std::pair{Style::montuno, 168.0},
                                     std::pair{Style::montuno, 184.0},
                                     std::pair{Style::montuno, 204.0},
                                     std::pair{Style::maqsum, 98.0},
                                     std::pair{Style::maqsum, 124.0},
                                     std::pair{Style::four_on_the_floor, 118.0},
                                     std::pair{Style::four_on_the_floor, 128.0}}) {
        const GeneratedMusic piece = music(style, {{0.0, bpm}}, 20.0);
        bars.push_back(seconds_to_lock(listen(piece), piece.beats, 0.0) / (4.0 * 60.0 / bpm));
    }
    std::sort(bars.begin(), bars.end());
    EXPECT_LE(bars[bars.size() / 2], 1.25) << "the median, in bars";
    EXPECT_LE(bars.back(), 4.0) << "the slowest";
}

/// How far the grid strays, seconds, where the beat goes missing from 12 s on for four bars while a
/// pad of three tones holds.
double strayed_without_drums(Style style, double bpm) {
    const double gap = 16.0 * 60.0 / bpm;
    MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, bpm}};
    plan.seconds = 12.0 + gap + 4.0;
    plan.channels = 1;
    plan.silences = {{12.0, 12.0 + gap}};
    const auto piece = generate(plan);
    EXPECT_TRUE(piece) << piece.error().message;
    std::vector<float> mono = piece->mono();
    for (std::size_t i = 0; i < mono.size(); ++i) {
        for (const double hertz : {220.0, 277.2, 329.6}) {
            const double angle = 2.0 * std::numbers::pi * hertz * static_cast<double>(i) / kRate;
            mono[i] += static_cast<float>(0.04 * std::sin(angle));
        }
    }
    const auto states = listen_to(mono);
    double most = 0.0;
    for (const ReferenceBeat& beat : piece->beats) {
        const double time = to_seconds(beat.time);
        if (time >= 12.0 && time <= 12.0 + gap) {
            const MusicState& then = states[static_cast<std::size_t>(time * 100.0)];
            most = std::max(most, distance_to_beat(then.grid, beat.time));
        }
    }
    return most;
}

TEST(Stage, holds_phase_through_four_bars_without_drums) {
    for (const Style style : {Style::drums, Style::montuno, Style::four_on_the_floor}) {
        for (const double bpm : {85.0, 100.0, 126.0, 150.0, 180.0}) {
            EXPECT_LE(strayed_without_drums(style, bpm), 0.040) << bpm << " BPM";
        }
    }
}

TEST(Stage, follows_ramps_of_3_percent_a_second) {
    for (const auto& [from, to] : {std::pair{150.0, 210.0}, std::pair{200.0, 145.0}}) {
        const double seconds = std::abs(std::log(to / from)) / 0.03;
        const GeneratedMusic piece =
            music(Style::montuno, {{0.0, from}, {8.0, from}, {8.0 + seconds, to}}, 12.0 + seconds);
        const auto score = test::score_beats(listen(piece), piece.beats, 5.0, 12.0 + seconds);
        EXPECT_GE(score.f_measure, 0.97) << from << " to " << to;
    }
}

struct Song {
    Style style = Style::drums;
    double bpm = 120.0;
};
/// Seconds until the second of two songs that are cut together is locked to.
double time_to_find(const Song& first, const Song& second) {
    constexpr double kCut = 15.0;
    std::vector<float> mono = music(first.style, {{0.0, first.bpm}}, kCut).mono();
    const GeneratedMusic next = music(second.style, {{0.0, second.bpm}}, 12.0);
    const std::vector<float> after = next.mono();
    mono.insert(mono.end(), after.begin(), after.end());
    std::vector<ReferenceBeat> beats = next.beats;
    for (ReferenceBeat& beat : beats) {
        beat.time += nanos_from_seconds(kCut);
    }
    return seconds_to_lock(listen_to(mono), beats, kCut);
}

TEST(Stage, finds_the_next_song_within_3_seconds) {
    for (const auto& [first, second] :
         {std::pair{Song{Style::montuno, 182.0}, Song{Style::four_on_the_floor, 124.0}},
          std::pair{Song{Style::four_on_the_floor, 128.0}, Song{Style::montuno, 190.0}},
          std::pair{Song{Style::maqsum, 104.0}, Song{Style::drums, 140.0}},
          std::pair{Song{Style::drums, 96.0}, Song{Style::maqsum, 118.0}}}) {
        EXPECT_LE(time_to_find(first, second), 3.0)
            << name_of(first.style) << " to " << name_of(second.style);
    }
}

/// Counting on from house it would take the half beats of rock for its beats, to the end.
TEST(Stage, finds_the_beat_of_rock_after_house_not_its_half_beat) {
    EXPECT_LE(time_to_find({Style::four_on_the_floor, 122.0}, {Style::backbeat, 120.0}), 4.0);
}

/// Slow house, hip-hop and drums have eighths as loud as beats.
TEST(Stage, does_not_flip_between_octaves) {
    for (const auto& [style, bpm] : {std::pair{Style::drums, 85.0},
                                     std::pair{Style::drums, 170.0},
                                     std::pair{Style::montuno, 200.0},
                                     std::pair{Style::maqsum, 100.0},
                                     std::pair{Style::four_on_the_floor, 96.0},
                                     std::pair{Style::four_on_the_floor, 104.0},
                                     std::pair{Style::four_on_the_floor, 125.0},
                                     std::pair{Style::boom_bap, 85.0},
                                     std::pair{Style::drums, 66.0}}) {
        const auto states = listen(music(style, {{0.0, bpm}}, 45.0));
        for (std::size_t hop = 800; hop < states.size(); ++hop) {
            ASSERT_NEAR(states[hop].grid.tempo.bpm() / bpm, 1.0, 0.1)
                << name_of(style) << " at " << bpm << " BPM, " << 0.01 * static_cast<double>(hop)
                << " s";
        }
    }
}

TEST(Stage, is_not_sure_of_any_beat_in_applause_and_talk) {
    EXPECT_LE(announced(listen_to(test::applause(30.0, 5)), 0.3F), 10) << "applause";
    EXPECT_LE(announced(listen_to(test::speech(30.0, 6)), 0.3F), 10) << "speech";
}

TEST(Stage, silence_freezes_it) {
    EXPECT_EQ(announced(listen_to(std::vector<float>(30 * kRate))), 0);
    // After music: the last beats that were due, then none, and the tempo stays.
    GeneratedMusic piece = music(Style::four_on_the_floor, {{0.0, 124.0}}, 15.0);
    std::vector<float> mono = piece.mono();
    mono.resize(mono.size() + 30 * kRate);
    const auto states = listen_to(mono);
    for (std::size_t hop = 1800; hop < states.size(); ++hop) {
        ASSERT_FALSE(states[hop].has_beat) << 0.01 * static_cast<double>(hop) << " s";
    }
    EXPECT_NEAR(states.back().grid.tempo.bpm(), 124.0, 2.0);
}

TEST(Stage, a_hint_of_the_genre_moves_the_tempo_that_is_sought_and_vetoes_nothing) {
    // Clicks say nothing of the octave; music with a beat of its own does.
    const auto tempo_with = [](Style style, double bpm, DanceId genre) {
        MusicAnalyzer analyzer;
        EXPECT_TRUE(analyzer.prepare(test::as_shipped(SampleRate(kRate))));
        analyzer.command({AnalyzerCommand::Kind::hint_genre, {}, static_cast<double>(genre)});
        Collect collect;
        analyzer.process(music(style, {{0.0, bpm}}, 15.0).mono(), collect);
        return collect.states.back().grid.tempo.bpm();
    };
    EXPECT_NEAR(tempo_with(Style::four_on_the_floor, 126.0, shipped::salsa), 126.0, 2.0);
    EXPECT_NEAR(tempo_with(Style::montuno, 186.0, shipped::belly), 186.0, 3.0);
    EXPECT_NEAR(tempo_with(Style::maqsum, 96.0, shipped::salsa), 96.0, 2.0);
    EXPECT_NEAR(tempo_with(Style::montuno, 186.0, shipped::salsa), 186.0, 3.0);
}

}  // namespace
}  // namespace raks::audio
