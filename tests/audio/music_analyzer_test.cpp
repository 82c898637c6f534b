#include "audio/music_analyzer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "audio/genre/genre_model.hpp"
#include "base/random.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using test::Collect;
using test::listen;
using test::music;

std::vector<MusicState> in_blocks(const GeneratedMusic& piece, std::size_t block) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped(piece.rate)));
    Collect collect;
    const CounterRandom random(block);
    std::uint64_t draw = 0;
    const std::vector<float> mono = piece.mono();
    for (std::size_t at = 0; at < mono.size();) {
        const std::size_t wanted = block == 0 ? 1 + random.below(draw++, 3000) : block;
        const std::size_t count = std::min(wanted, mono.size() - at);
        analyzer.process(std::span(mono).subspan(at, count), collect);
        at += count;
    }
    return collect.states;
}

TEST(MusicAnalyzer, any_blocks_give_the_same_bits) {
    for (const int hertz : {44'100, 48'000}) {
        const GeneratedMusic piece = music(Style::drums, {{0.0, 120.0}}, 5.0, hertz);
        const auto whole = in_blocks(piece, 1'000'000);
        ASSERT_GT(whole.size(), 490U);
        for (const std::size_t block : {1U, 7U, 64U, 256U, 1000U, 8192U, 0U}) {
            const auto states = in_blocks(piece, block);
            ASSERT_EQ(states.size(), whole.size()) << block;
            for (std::size_t i = 0; i < whole.size(); ++i) {
                ASSERT_TRUE(states[i] == whole[i]) << i << ", blocks of " << block;
            }
        }
    }
}

TEST(MusicAnalyzer, a_prefix_gives_the_same_states_as_the_whole) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 12.0);
    const auto whole = listen(piece);
    for (const double seconds : {0.5, 3.21, 7.77}) {
        GeneratedMusic prefix = piece;
        prefix.samples.resize(static_cast<std::size_t>(seconds * 48'000));
        const auto states = listen(prefix);
        ASSERT_GT(states.size(), static_cast<std::size_t>(seconds * 100) - 5);
        for (std::size_t i = 0; i < states.size(); ++i) {
            ASSERT_TRUE(states[i] == whole[i]) << i;
        }
    }
}

TEST(MusicAnalyzer, hops_are_10_ms_apart_and_come_within_the_delay) {
    for (const int hertz : {8'000, 11'025, 22'050, 44'100, 48'000, 96'000, 192'000}) {
        const SampleRate rate(hertz);
        MusicAnalyzer analyzer;
        ASSERT_TRUE(analyzer.prepare(test::as_shipped(rate)));
        EXPECT_LT(analyzer.delay(), std::chrono::milliseconds(40)) << hertz;
        Collect collect;
        const std::vector<float> block(static_cast<std::size_t>(hertz) / 50 + 1);
        std::int64_t fed = 0;
        while (fed < hertz * 3) {
            analyzer.process(block, collect);
            fed += static_cast<std::int64_t>(block.size());
            const StreamTime complete = rate.time_of(fed) - analyzer.delay();
            ASSERT_GE(time_of_hop(static_cast<HopIndex>(collect.states.size())), complete)
                << hertz << ": a hop is missing";
        }
        for (std::size_t i = 0; i < collect.states.size(); ++i) {
            ASSERT_EQ(collect.states[i].hop, static_cast<HopIndex>(i));
            ASSERT_EQ(collect.states[i].time, time_of_hop(static_cast<HopIndex>(i)));
        }
    }
}

TEST(MusicAnalyzer, the_rate_of_the_input_does_not_move_the_beats) {
    for (const int hertz : {22'050, 44'100, 96'000}) {
        const GeneratedMusic piece = music(Style::drums, {{0.0, 120.0}}, 20.0, hertz);
        const test::BeatScore score = test::score_beats(listen(piece), piece.beats, 8.0, 19.9);
        EXPECT_GE(score.f_measure, 0.97) << hertz;
        EXPECT_LE(std::abs(score.median_error), 0.005) << hertz;
    }
}

TEST(MusicAnalyzer, nan_and_infinities_count_as_silence) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    Collect collect;
    std::vector<float> samples(48'000, std::numeric_limits<float>::quiet_NaN());
    samples[100] = std::numeric_limits<float>::infinity();
    samples[200] = 1e30F;
    analyzer.process(samples, collect);
    analyzer.process(std::vector<float>(48'000), collect);
    EXPECT_EQ(analyzer.bad_samples(), 47'999U);
    for (const MusicState& state : collect.states) {
        ASSERT_TRUE(std::isfinite(state.level_dbfs));
        ASSERT_TRUE(std::isfinite(state.loudness_lufs));
        ASSERT_TRUE(std::isfinite(state.grid.tempo.bpm()));
        ASSERT_TRUE(std::isfinite(state.energy.now + state.energy.lately + state.energy.longer));
    }
    EXPECT_TRUE(collect.states.back().is_silent);
}

TEST(MusicAnalyzer, loudness_of_a_full_scale_sine_is_minus_3_lufs) {
    // EBU Tech 3341: a 1 kHz sine at full scale in one channel is -3.01 LUFS.
    GeneratedMusic piece;
    piece.channels = 1;
    for (int i = 0; i < 96'000; ++i) {
        piece.samples.push_back(static_cast<float>(std::sin(2.0 * M_PI * 1000.0 * i / 48'000)));
    }
    const auto states = listen(piece);
    EXPECT_NEAR(states[150].loudness_lufs, -3.01F, 0.1F);
    EXPECT_NEAR(states[150].level_dbfs, -3.01F, 0.1F);
}

TEST(MusicAnalyzer, lost_audio_moves_stream_time_and_is_said) {
    const GeneratedMusic piece = music(Style::drums, {{0.0, 120.0}}, 20.0);
    const std::vector<float> mono = piece.mono();
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    Collect collect;
    const std::size_t cut = 48'000 * 10;
    analyzer.process(std::span(mono).first(cut), collect);
    analyzer.skip(std::chrono::milliseconds(500));
    analyzer.process(std::span(mono).subspan(cut + 24'000), collect);
    ASSERT_GE(collect.states.size(), 1990U);
    int discontinuities = 0;
    for (std::size_t i = 0; i < collect.states.size(); ++i) {
        ASSERT_EQ(collect.states[i].hop, static_cast<HopIndex>(i));
        discontinuities += collect.states[i].is_discontinuity ? 1 : 0;
    }
    EXPECT_EQ(discontinuities, 1);
    const test::BeatScore score = test::score_beats(collect.states, piece.beats, 13.5, 19.9);
    EXPECT_GE(score.f_measure, 0.95) << "the beat is found again at its true time";
}

/// The tempo after silence in which 400 ms are lost at once, as while a program starts.
double tempo_after_silence_with_a_gap(std::optional<AnalyzerCommand::Kind> key) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped()));
    Collect collect;
    const std::vector<float> silence(48'000 / 5);
    analyzer.process(silence, collect);
    if (key) {
        analyzer.command({*key, {}, 0.0});
    }
    analyzer.process(silence, collect);
    analyzer.skip(std::chrono::milliseconds(400));
    for (int i = 0; i < 20; ++i) {
        analyzer.process(silence, collect);
    }
    for (const MusicState& state : collect.states) {
        EXPECT_TRUE(state.is_silent) << state.hop;
    }
    return collect.states.back().grid.tempo.bpm();
}

TEST(MusicAnalyzer, in_silence_lost_audio_leaves_the_tempo_where_it_was_put) {
    EXPECT_DOUBLE_EQ(tempo_after_silence_with_a_gap({}), 120.0);
    EXPECT_DOUBLE_EQ(tempo_after_silence_with_a_gap(AnalyzerCommand::Kind::half_tempo), 60.0);
}

TEST(MusicAnalyzer, reset_gives_the_same_bits_again) {
    const GeneratedMusic piece = music(Style::four_on_the_floor, {{0.0, 124.0}}, 4.0);
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    Collect first;
    analyzer.process(piece.mono(), first);
    analyzer.reset();
    Collect second;
    analyzer.process(piece.mono(), second);
    ASSERT_EQ(first.states.size(), second.states.size());
    for (std::size_t i = 0; i < first.states.size(); ++i) {
        ASSERT_TRUE(first.states[i] == second.states[i]) << i;
    }
}

/// The analyzer's MFCC at each hop.
class CollectMfcc final : public MusicAnalyzer::Sink {
 public:
    explicit CollectMfcc(const MusicAnalyzer& analyzer) : analyzer_(analyzer) {}
    void on_state(const MusicState&) noexcept override { vectors.push_back(analyzer_.mfcc()); }
    std::vector<MfccVector> vectors;

 private:
    const MusicAnalyzer& analyzer_;
};

std::vector<MfccVector> mfcc_heard(const AnalyzerConfig& config, const GeneratedMusic& piece) {
    MusicAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(config));
    CollectMfcc collect(analyzer);
    analyzer.process(piece.mono(), collect);
    return collect.vectors;
}

TEST(MusicAnalyzer, computes_mfcc_for_a_genre_model_or_for_who_asks) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 2.0);
    const AnalyzerConfig shipped = test::as_shipped();
    AnalyzerConfig asked;
    asked.cepstral_mean = shipped.genre_model->features.cepstral_mean;
    const auto vectors = mfcc_heard(asked, piece);
    EXPECT_EQ(vectors, mfcc_heard(shipped, piece));
    EXPECT_NE(vectors.back(), MfccVector{});
    for (const MfccVector& vector : mfcc_heard({}, piece)) {
        EXPECT_EQ(vector, MfccVector{});
    }
}

TEST(MusicAnalyzer, rates_out_of_range_are_refused) {
    for (const int hertz : {-1, 0, 7'999, 192'001}) {
        MusicAnalyzer analyzer;
        const auto prepared = analyzer.prepare({.sample_rate = SampleRate(hertz)});
        ASSERT_FALSE(prepared);
        EXPECT_EQ(prepared.error().message,
                  "sample rate is " + std::to_string(hertz) + " Hz, must be 8000 to 192000");
    }
}

TEST(MusicAnalyzer, sixty_seconds_with_jump_and_silence_keep_the_real_time_rules) {
    MusicPlan plan;
    plan.style = Style::montuno;
    plan.tempo = {{0.0, 170.0}, {30.0, 170.0}, {30.0, 200.0}};
    plan.seconds = 60.0;
    plan.channels = 1;
    plan.silences = {{40.0, 45.0}};
    const auto piece = generate(plan);
    ASSERT_TRUE(piece);
    const std::vector<float> mono = piece->mono();
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    Collect collect;
    const CounterRandom random(2);
    raks::test::RealtimeScope scope;
    std::uint64_t draw = 0;
    for (std::size_t at = 0; at < mono.size();) {
        const std::size_t count =
            std::min<std::size_t>(1 + random.below(draw++, 1024), mono.size() - at);
        analyzer.process(std::span(mono).subspan(at, count), collect);
        if (draw == 500) {
            analyzer.skip(std::chrono::milliseconds(30));
            analyzer.command({AnalyzerCommand::Kind::nudge, StreamTime{}, 0.01});
        }
        at += count;
    }
    analyzer.reset();
    // Waits are the scheduler's on a busy machine only when a lock or sleep was taken: none here.
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_GT(collect.states.size(), 5990U);
}

TEST(MusicAnalyzer, hints_the_recognised_dance_to_the_beat_tracker) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 186.0}}, 15.0);
    const std::vector<MusicState> recognised = listen(piece);
    const auto told = [&](const std::vector<AnalyzerCommand>& hints) {
        AnalyzerConfig config = test::as_shipped(piece.rate);
        config.genre_model = nullptr;
        MusicAnalyzer analyzer;
        EXPECT_TRUE(analyzer.prepare(config));
        for (const AnalyzerCommand& hint : hints) {
            analyzer.command(hint);
        }
        Collect collect;
        analyzer.process(piece.mono(), collect);
        return collect.states;
    };
    std::vector<AnalyzerCommand> hints;
    for (std::size_t hop = 1; hop < recognised.size(); ++hop) {
        if (recognised[hop].genre != recognised[hop - 1].genre) {
            hints.push_back({AnalyzerCommand::Kind::hint_genre,
                             recognised[hop].time + std::chrono::milliseconds(1),
                             static_cast<double>(recognised[hop].genre)});
        }
    }
    ASSERT_FALSE(hints.empty());
    const std::vector<MusicState> hinted = told(hints);
    const std::vector<MusicState> unhinted = told({});
    ASSERT_EQ(hinted.size(), recognised.size());
    bool is_heeded = false;
    for (std::size_t hop = 0; hop < recognised.size(); ++hop) {
        ASSERT_EQ(recognised[hop].grid.tempo, hinted[hop].grid.tempo) << hop;
        ASSERT_EQ(recognised[hop].grid.confidence, hinted[hop].grid.confidence) << hop;
        is_heeded |= hinted[hop].grid.confidence != unhinted[hop].grid.confidence;
    }
    EXPECT_TRUE(is_heeded);
}

// A song behind another one is heard as well as by itself, and nothing is allocated for it.
TEST(MusicAnalyzer, a_song_that_begins_is_heard_as_if_nothing_had_been_before) {
    const GeneratedMusic before = music(Style::backbeat, {{0.0, 171.0}}, 12.0);
    const GeneratedMusic song = music(Style::drums, {{0.0, 104.0}}, 8.0);
    const std::vector<MusicState> alone = listen(song);
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped(song.rate)));
    Collect collect;
    analyzer.process(before.mono(), collect);
    const std::size_t first = collect.states.size();
    const Beats counted = collect.states.back().grid.anchor_beat;
    raks::test::RealtimeScope scope;
    analyzer.tell({{}, 104.0});
    analyzer.begin_song();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    analyzer.process(song.mono(), collect);
    const std::vector<MusicState> heard(collect.states.begin() + static_cast<std::ptrdiff_t>(first),
                                        collect.states.end());
    EXPECT_TRUE(heard.front().is_discontinuity);
    EXPECT_EQ(heard.front().hop, static_cast<HopIndex>(first)) << "time goes on";
    EXPECT_GE(heard.front().grid.anchor_beat, counted) << "and so do beats";
    // From when on its tempo is known.
    const auto known_from = [](const std::vector<MusicState>& states) {
        std::size_t hop = states.size();
        while (hop > 0 && std::abs(states[hop - 1].grid.tempo.bpm() / 104.0 - 1.0) < 0.03) {
            --hop;
        }
        return static_cast<int>(hop);
    };
    EXPECT_LE(known_from(heard), known_from(alone) + 60);
    EXPECT_LT(known_from(heard), 500);
}

TEST(MusicAnalyzer, a_held_tempo_outlives_a_song) {
    const GeneratedMusic song = music(Style::drums, {{0.0, 120.0}}, 6.0);
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped(song.rate)));
    Collect collect;
    analyzer.command({AnalyzerCommand::Kind::set_tempo, StreamTime{}, 120.0});
    analyzer.process(song.mono(), collect);
    analyzer.tell({{}, 90.0});
    analyzer.begin_song();
    analyzer.process(song.mono(), collect);
    EXPECT_TRUE(collect.states.back().is_tempo_held);
    EXPECT_NEAR(collect.states.back().grid.tempo.bpm(), 120.0, 1.0);
}

}  // namespace
}  // namespace raks::audio
