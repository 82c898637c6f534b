#include "audio/beat/paper_beat.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using test::Collect;
using test::music;
using test::score_beats;

/// Onsets of height 1 every `period` hops, the last at hop `last` of a window of `count`.
std::vector<float> pulses(std::size_t count, double period, double last) {
    std::vector<float> onsets(count, 0.0F);
    for (double at = last; at >= 0.0; at -= period) {
        const auto i = static_cast<std::size_t>(at);
        const auto share = static_cast<float>(at - std::floor(at));
        onsets[i] += 1.0F - share;
        if (i + 1 < count) {
            onsets[i + 1] += share;
        }
    }
    return onsets;
}

PaperEstimate estimate_of(std::span<const float> onsets) {
    PaperWindow window;
    window.begin(onsets);
    for (int i = 0; i < PaperWindow::kSteps; ++i) {
        EXPECT_FALSE(window.is_done());
        window.step();
    }
    EXPECT_TRUE(window.is_done());
    return window.estimate();
}

std::vector<MusicState> analyze_by_paper(const GeneratedMusic& piece, std::size_t block) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare({.sample_rate = piece.rate, .beat_method = BeatMethod::paper}));
    Collect collect;
    const std::vector<float> mono = piece.mono();
    for (std::size_t at = 0; at < mono.size(); at += block) {
        analyzer.process(std::span(mono).subspan(at, std::min(block, mono.size() - at)), collect);
    }
    return collect.states;
}

TEST(PaperWindow, pulses_give_their_period_and_phase) {
    for (const double period : {31.0, 38.0, 44.0, 50.0, 58.25}) {
        for (const double last : {599.0 - period + 1.0, 580.0, 598.0}) {
            const PaperEstimate estimate = estimate_of(pulses(600, period, last));
            EXPECT_NEAR(estimate.period_hops, period, 0.35) << period;
            const double beats = (estimate.last_beat - last) / period;
            // 0.6 hops: the phases are tried on hops, a parabola between.
            EXPECT_NEAR(beats, std::round(beats), 0.6 / period) << period << " " << last;
            EXPECT_GT(estimate.confidence, 0.5F);
        }
    }
}

TEST(PaperWindow, nothing_gives_no_confidence) {
    EXPECT_EQ(estimate_of(std::vector<float>(600, 0.0F)).confidence, 0.0F);
    EXPECT_EQ(estimate_of(std::vector<float>(600, 3.0F)).confidence, 0.0F);
    EXPECT_EQ(estimate_of({}).confidence, 0.0F);
}

TEST(PaperFlux, silence_has_no_onsets_and_a_click_has_one) {
    PaperFlux flux;
    std::vector<float> window(PaperFlux::kWindow, 0.0F);
    int onsets = 0;
    const int click = 100;  // hop whose window's middle it is
    for (int hop = 0; hop < 200; ++hop) {
        std::fill(window.begin(), window.end(), 0.0F);
        const int at = PaperFlux::kWindow / 2 + (click - hop) * PaperFlux::kHop;
        if (at >= 0 && at < PaperFlux::kWindow) {
            window[static_cast<std::size_t>(at)] = 0.9F;
        }
        const PaperFlux::Frame frame = flux.add(window);
        const int frame_hop = hop - PaperFlux::kDelay;
        if (frame.onset() > 0.0F) {
            ++onsets;
            EXPECT_NEAR(frame_hop, click, 2);
        }
    }
    EXPECT_GE(onsets, 1);
}

TEST(PaperTracker, steady_clicks_are_followed_by_stream_and_by_file) {
    for (const double bpm : {100.0, 128.0, 150.0}) {
        const GeneratedMusic piece = music(Style::clicks, {{0.0, bpm}}, 20.0);
        const auto streamed = score_beats(analyze_by_paper(piece, 256), piece.beats, 6.0, 19.5);
        EXPECT_GE(streamed.f_measure, 0.9) << bpm;
        EXPECT_LE(std::abs(streamed.median_error), 0.010) << bpm;

        PaperFile file;
        ASSERT_TRUE(file.prepare(piece.rate));
        file.add(piece.mono());
        std::vector<MusicState> states;
        for (const BeatEvent& beat : file.finish(std::chrono::seconds(20))) {
            EXPECT_EQ(beat.bar_position, 0);
            EXPECT_LT(beat.time, stream_time_from_seconds(20.0));
            MusicState state;
            state.has_beat = true;
            state.beat = beat;
            states.push_back(state);
        }
        EXPECT_GE(score_beats(states, piece.beats, 6.0, 19.5).f_measure, 0.9) << bpm;
    }
}

TEST(PaperTracker, any_blocks_give_the_same_bits) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 10.0);
    const auto whole = analyze_by_paper(piece, 8192);
    const auto pieces = analyze_by_paper(piece, 97);
    ASSERT_EQ(whole.size(), pieces.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        ASSERT_EQ(whole[i].has_beat, pieces[i].has_beat);
        ASSERT_EQ(whole[i].beat.time, pieces[i].beat.time);
        ASSERT_EQ(whole[i].grid.tempo, pieces[i].grid.tempo);
        ASSERT_EQ(whole[i].grid.anchor_time, pieces[i].grid.anchor_time);
    }
}

TEST(PaperTracker, a_beat_is_told_no_later_than_50_ms_after_it_sounds_and_never_twice) {
    const auto states =
        analyze_by_paper(music(Style::four_on_the_floor, {{0.0, 124.0}, {12.0, 90.0}}, 24.0), 256);
    StreamTime last{std::chrono::seconds(-1)};
    int beats = 0;
    for (const MusicState& state : states) {
        if (state.has_beat) {
            ++beats;
            EXPECT_GE(state.beat.time, state.audio_end - std::chrono::milliseconds(50));
            EXPECT_LE(state.beat.time, state.audio_end + kHop);
            EXPECT_GT(state.beat.time - last, std::chrono::milliseconds(140));
            last = state.beat.time;
        }
    }
    EXPECT_GE(beats, 30);
}

TEST(PaperTracker, silence_announces_nothing) {
    GeneratedMusic piece = music(Style::drums, {{0.0, 120.0}}, 1.0);
    std::fill(piece.samples.begin(), piece.samples.end(), 0.0F);
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare({.sample_rate = piece.rate, .beat_method = BeatMethod::paper}));
    Collect collect;
    const std::vector<float> mono = piece.mono();
    for (int second = 0; second < 30; ++second) {
        analyzer.process(mono, collect);
    }
    for (const MusicState& state : collect.states) {
        ASSERT_FALSE(state.has_beat);
        ASSERT_EQ(state.grid.confidence, 0.0F);
    }
}

TEST(PaperTracker, nothing_allocates_or_locks_while_it_listens) {
    const GeneratedMusic piece = music(Style::drums, {{0.0, 140.0}}, 15.0);
    const std::vector<float> mono = piece.mono();
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare({.sample_rate = piece.rate, .beat_method = BeatMethod::paper}));
    Collect collect;
    {
        raks::test::RealtimeScope scope;
        for (std::size_t at = 0; at + 256 <= mono.size(); at += 256) {
            analyzer.process(std::span(mono).subspan(at, 256), collect);
            if (at == 256 * 800) {
                analyzer.skip(std::chrono::milliseconds(500));
            }
        }
        analyzer.reset();
    }
    EXPECT_GT(collect.states.size(), 1400U);
}

TEST(PaperBeats, frames_without_onsets_have_no_beats) {
    EXPECT_TRUE(paper_beats({}).empty());
    const std::vector<PaperFlux::Frame> frames(1300, {1.0F, 2.0F});
    EXPECT_TRUE(paper_beats(frames).empty());
}

}  // namespace
}  // namespace raks::audio
