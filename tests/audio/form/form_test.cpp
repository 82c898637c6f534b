// What music does, from samples to states: live by MusicAnalyzer, known ahead by SongAnalyzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "audio/song/song_plan.hpp"
#include "tests/audio/listen.hpp"

namespace raks::audio {
namespace {

using Kind = MusicEvent::Kind;

constexpr std::array kBands = {Style::drums,
                               Style::montuno,
                               Style::maqsum,
                               Style::four_on_the_floor,
                               Style::backbeat,
                               Style::boom_bap,
                               Style::oom_pah_pah};

GeneratedMusic song(Style style, const std::string& form, double seconds) {
    MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, usual_tempo(style).bpm()}};
    plan.seconds = seconds;
    plan.channels = 1;
    if (!form.empty()) {
        plan.form = *parse_form(form);
    }
    auto piece = generate(plan);
    EXPECT_TRUE(piece) << piece.error().message;
    return *piece;
}

SongPlan known(const GeneratedMusic& piece) {
    SongAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped(piece.rate)));
    analyzer.process(piece.samples);
    return analyzer.finish();
}

std::vector<MusicState> events_in(const std::vector<MusicState>& states) {
    std::vector<MusicState> result;
    std::copy_if(
        states.begin(), states.end(), std::back_inserter(result), [](const MusicState& state) {
            return state.event.kind != Kind::none;
        });
    return result;
}

/// The state that told an event of this kind within so many seconds of a time; null: none did.
const MusicState* told(const std::vector<MusicState>& states, Kind kind, double at, double within) {
    for (const MusicState& state : states) {
        if (state.event.kind == kind && std::abs(to_seconds(state.event.time) - at) <= within) {
            return &state;
        }
    }
    return nullptr;
}

TEST(Form, steady_music_of_every_style_begins_and_does_nothing_else) {
    for (const Style style : kBands) {
        const GeneratedMusic piece = song(style, "", 20.0);
        for (const MusicState& state : events_in(test::listen(piece))) {
            EXPECT_EQ(state.event.kind, Kind::entry) << name_of(style);
            EXPECT_LT(state.event.time, StreamTime(std::chrono::milliseconds(500)));
        }
        for (const MusicState& state : events_in(known(piece).states)) {
            EXPECT_TRUE(state.event.kind == Kind::entry || state.event.kind == Kind::end)
                << name_of(style) << ' ' << static_cast<int>(state.event.kind) << ' ' << state.hop;
        }
    }
}

TEST(Form, a_stop_is_known_within_120_ms_and_the_entry_after_it_at_once) {
    for (const Style style : {Style::montuno, Style::four_on_the_floor, Style::backbeat}) {
        const double beat = usual_tempo(style).seconds_per_beat();
        const auto states = test::listen(song(style, "full:32,stop:4,full:16", 52 * beat));
        const MusicState* const stop = told(states, Kind::stop, 32 * beat, 0.03);
        ASSERT_NE(stop, nullptr) << name_of(style);
        EXPECT_LE(to_seconds(stop->time) - 32 * beat, 0.105) << name_of(style);
        EXPECT_EQ(stop->part, MusicPart::stopped);
        EXPECT_LT(states[static_cast<std::size_t>(stop->hop) + 20].energy.now, 0.01F);
        const MusicState* const entry = told(states, Kind::entry, 36 * beat, 0.03);
        ASSERT_NE(entry, nullptr) << name_of(style);
        EXPECT_LE(to_seconds(entry->time) - 36 * beat, 0.04) << name_of(style);
    }
}

TEST(Form, a_drop_after_a_breakdown_is_known_within_a_beat) {
    for (const Style style : {Style::four_on_the_floor, Style::backbeat, Style::boom_bap}) {
        const double beat = usual_tempo(style).seconds_per_beat();
        const auto states = test::listen(song(style, "full:48,filtered:16,drop:16", 80 * beat));
        const MusicState* const breakdown = told(states, Kind::breakdown, 48 * beat, beat);
        ASSERT_NE(breakdown, nullptr) << name_of(style);
        EXPECT_LT(to_seconds(breakdown->time) - 48 * beat, 4 * beat) << name_of(style);
        const auto half = static_cast<std::size_t>(100.0 * 56 * beat);
        EXPECT_EQ(states[half].part, MusicPart::breakdown) << name_of(style);
        EXPECT_LT(states[half].energy.lately, 0.3F) << name_of(style);
        const MusicState* const drop = told(states, Kind::drop, 64 * beat, 0.1);
        ASSERT_NE(drop, nullptr) << name_of(style);
        EXPECT_LE(to_seconds(drop->time) - 64 * beat, beat) << name_of(style);
        EXPECT_EQ(states.back().part, MusicPart::playing) << name_of(style);
    }
}

TEST(Form, drums_that_leave_while_the_level_stays_are_a_breakdown) {
    for (const Style style : {Style::four_on_the_floor, Style::backbeat}) {
        const double beat = usual_tempo(style).seconds_per_beat();
        const GeneratedMusic piece = song(style, "full:64,riff:16,drop:32,ending:4", 116 * beat);
        const SongPlan plan = known(piece);
        EXPECT_NE(told(plan.states, Kind::breakdown, 64 * beat, beat), nullptr) << name_of(style);
        EXPECT_NE(told(plan.states, Kind::drop, 80 * beat, beat), nullptr) << name_of(style);
        EXPECT_EQ(events_in(plan.states).size(), 4U) << name_of(style);
        const auto states = test::listen(piece);
        const MusicState* const breakdown = told(states, Kind::breakdown, 64 * beat, beat);
        ASSERT_NE(breakdown, nullptr) << name_of(style);
        EXPECT_LE(to_seconds(breakdown->time) - 64 * beat, 1.5) << name_of(style);
        EXPECT_NE(told(states, Kind::drop, 80 * beat, beat), nullptr) << name_of(style);
    }
}

TEST(Form, of_a_known_song_stops_in_a_row_are_all_told) {
    const Style style = Style::backbeat;
    const double beat = usual_tempo(style).seconds_per_beat();
    const std::string stops = "stop:2,full:2,stop:2,full:2,stop:2,full:2,stop:2,";
    const SongPlan plan = known(song(style, "full:32," + stops + "full:32,ending:4", 82 * beat));
    for (const int at : {32, 36, 40, 44}) {
        EXPECT_NE(told(plan.states, Kind::stop, at * beat, 0.1), nullptr) << at;
        EXPECT_NE(told(plan.states, Kind::entry, (at + 2) * beat, 0.1), nullptr) << at;
    }
}

TEST(Form, the_last_chord_is_the_end_and_a_fade_is_no_breakdown) {
    const Style style = Style::backbeat;
    const double beat = usual_tempo(style).seconds_per_beat();
    GeneratedMusic rings = song(style, "full:48,ending:16", 64 * beat);
    GeneratedMusic fades = song(style, "full:48,fade-out:24", 72 * beat);
    for (GeneratedMusic* piece : {&rings, &fades}) {
        piece->samples.resize(piece->samples.size() + 4 * 48'000);
    }
    for (const auto& states : {known(rings).states, test::listen(rings)}) {
        EXPECT_NE(told(states, Kind::end, 48 * beat, 0.1), nullptr);
    }
    EXPECT_EQ(events_in(known(rings).states).size(), 2U);
    for (const auto& states : {known(fades).states, test::listen(fades)}) {
        EXPECT_NE(told(states, Kind::end, 72 * beat, 2.5), nullptr);
        EXPECT_EQ(told(states, Kind::breakdown, 60 * beat, 14 * beat), nullptr);
    }
}

TEST(Form, noise_a_steady_tone_and_clicks_do_nothing_but_begin_and_end) {
    for (const int kind : {0, 1, 2}) {
        GeneratedMusic piece;
        piece.channels = 1;
        std::uint32_t random = 1;
        for (std::size_t i = 0; i < 30 * 48'000; ++i) {
            random = random * 1'664'525U + 1'013'904'223U;
            const float noise = static_cast<float>(random >> 8U) / 8'388'608.0F - 1.0F;
            const float tone = std::sin(0.05F * static_cast<float>(i % 48'000));
            const float click = i % 24'000 < 96 ? noise : 0.0F;
            piece.samples.push_back(0.2F * (kind == 0 ? noise : kind == 1 ? tone : click));
        }
        for (const auto& states : {known(piece).states, test::listen(piece)}) {
            for (const MusicState& state : events_in(states)) {
                EXPECT_TRUE(state.event.kind == Kind::entry || state.event.kind == Kind::end)
                    << kind << ' ' << music_event_name(state.event.kind) << ' ' << state.hop;
            }
        }
    }
}

TEST(Form, of_a_known_song_each_event_comes_at_its_own_hop) {
    const Style style = Style::four_on_the_floor;
    const double beat = usual_tempo(style).seconds_per_beat();
    const GeneratedMusic piece =
        song(style, "full:32,breakdown:16,build-up:16,stop:4,drop:32,ending:8", 112 * beat);
    const SongPlan plan = known(piece);
    const std::vector<MusicState> events = events_in(plan.states);
    const std::vector<Kind> wanted = {Kind::entry,
                                      Kind::breakdown,
                                      Kind::build_up,
                                      Kind::stop,
                                      Kind::entry,
                                      Kind::drop,
                                      Kind::end};
    ASSERT_EQ(events.size(), wanted.size());
    const std::array<double, 7> beats = {0, 32, 48, 64, 68, 68, 100};
    for (std::size_t i = 0; i < events.size(); ++i) {
        EXPECT_EQ(events[i].event.kind, wanted[i]) << i;
        EXPECT_NEAR(to_seconds(events[i].event.time), beats[i] * beat, 0.5 * beat) << i;
        EXPECT_LE(events[i].time - events[i].event.time, 2 * kHop) << i;
    }
    // What comes next is known at every hop, from the first one on.
    for (const MusicState& state : plan.states) {
        const auto next = std::find_if(events.begin(), events.end(), [&](const MusicState& other) {
            return other.hop > state.hop;
        });
        for (std::ptrdiff_t i = 0; i < 2; ++i) {
            const MusicEvent& ahead = state.ahead.events[static_cast<std::size_t>(i)];
            const bool is_there = events.end() - next > i;
            ASSERT_EQ(ahead.kind, is_there ? (next + i)->event.kind : Kind::none) << state.hop;
        }
    }
    // At another place of a stream the times move with it.
    const MusicState& told_stop = events[3];
    const MusicState shifted = plan.at(told_stop.time, told_stop.hop + 1'000);
    EXPECT_EQ(shifted.event.time - told_stop.event.time, std::chrono::seconds(10));
    EXPECT_EQ(shifted.ahead.events[0].time - told_stop.ahead.events[0].time,
              std::chrono::seconds(10));
    EXPECT_EQ(plan.at(plan.states.back().time + std::chrono::seconds(2), 0).part,
              MusicPart::stopped);
}

TEST(Form, accents_lie_on_strokes_and_know_whether_a_beat_is_there) {
    const double beat = 0.5;  // drums at 120
    const auto states = test::listen(song(Style::drums, "", 20.0));
    int accents = 0;
    for (const MusicState& state : states) {
        if (state.accent.strength <= 0.0F || to_seconds(state.accent.time) < 8.0) {
            continue;
        }
        ++accents;
        // Strokes lie on quarters of a beat.
        const double beats = to_seconds(state.accent.time) / beat;
        EXPECT_NEAR(4.0 * beats, std::round(4.0 * beats), 0.2);
        const bool is_near = std::abs(beats - std::round(beats)) * beat < 0.07;
        EXPECT_EQ(state.accent.is_on_beat, is_near) << state.hop;
        EXPECT_LE(state.accent.strength, 1.0F);
        EXPECT_LE(state.time - state.accent.time, 3 * kHop);
    }
    EXPECT_GE(accents, 10);
}

TEST(Form, twenty_decibels_less_are_the_same_form_and_energies) {
    GeneratedMusic piece = song(Style::montuno, "full:32,stop:4,full:16,filtered:16,drop:16", 27.0);
    const auto loud = test::listen(piece);
    for (float& sample : piece.samples) {
        sample *= 0.1F;
    }
    const auto soft = test::listen(piece);
    ASSERT_EQ(loud.size(), soft.size());
    for (std::size_t i = 0; i < loud.size(); ++i) {
        ASSERT_NEAR(loud[i].energy.now, soft[i].energy.now, 0.06F) << i;
    }
    const auto loud_events = events_in(loud);
    ASSERT_EQ(loud_events.size(), events_in(soft).size());
    for (const MusicState& state : loud_events) {
        EXPECT_NE(told(soft, state.event.kind, to_seconds(state.event.time), 0.1), nullptr)
            << state.hop;
    }
}

TEST(Form, silence_is_a_stop_without_events) {
    GeneratedMusic piece;
    piece.channels = 1;
    piece.samples.resize(3 * 48'000);
    for (const MusicState& state : test::listen(piece)) {
        ASSERT_EQ(state.part, MusicPart::stopped);
        ASSERT_EQ(state.event.kind, Kind::none);
        ASSERT_EQ(state.energy.now, 0.0F);
    }
    EXPECT_TRUE(events_in(known(piece).states).empty());
}

}  // namespace
}  // namespace raks::audio
