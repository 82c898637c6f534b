// Rates, faults and lengths that music comes in: the beats must not mind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "audio/resample/resampler.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using test::Collect;
using test::listen;
using test::music;

std::vector<double> beat_times(const std::vector<MusicState>& states, double from) {
    std::vector<double> times;
    for (const MusicState& state : states) {
        if (state.has_beat && to_seconds(state.beat.time) >= from) {
            times.push_back(to_seconds(state.beat.time));
        }
    }
    return times;
}

struct Agreement {
    double f_measure = 0.0;     ///< +-5 ms
    double median_shift = 0.0;  ///< seconds, absolute
};

Agreement agreement_of(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> shifts;
    std::size_t at = 0;
    for (const double time : a) {
        while (at < b.size() && b[at] < time - 0.005) {
            ++at;
        }
        if (at < b.size() && std::abs(b[at] - time) <= 0.005) {
            shifts.push_back(b[at++] - time);
        }
    }
    if (shifts.empty()) {
        return {};
    }
    const double hits = static_cast<double>(shifts.size());
    std::sort(shifts.begin(), shifts.end());
    return {2.0 * hits / static_cast<double>(a.size() + b.size()),
            std::abs(shifts[shifts.size() / 2])};
}

/// The same sound at another rate.
GeneratedMusic at_rate(const GeneratedMusic& piece, int hertz) {
    if (piece.rate == SampleRate(hertz)) {
        return piece;
    }
    GeneratedMusic other = piece;
    other.rate = SampleRate(hertz);
    Resampler resampler;
    EXPECT_TRUE(resampler.prepare(piece.rate, other.rate));
    other.samples.resize(piece.samples.size());  // the piece has the highest rate
    const auto progress = resampler.process(piece.samples, other.samples);
    EXPECT_EQ(progress.taken, piece.samples.size());
    other.samples.resize(progress.made);
    return other;
}

TEST(Rates, any_two_give_the_same_beats) {
    for (const auto& [style, bpm] : {std::pair{Style::montuno, 184.0},
                                     std::pair{Style::drums, 120.0},
                                     std::pair{Style::maqsum, 112.0},
                                     std::pair{Style::four_on_the_floor, 126.0}}) {
        const GeneratedMusic piece = music(style, {{0.0, bpm}}, 20.0, 192'000);
        std::vector<std::vector<double>> heard;
        for (const int hertz : {22'050, 32'000, 44'100, 48'000, 96'000, 192'000}) {
            heard.push_back(beat_times(listen(at_rate(piece, hertz)), 5.0));
        }
        for (std::size_t a = 0; a < heard.size(); ++a) {
            for (std::size_t b = a + 1; b < heard.size(); ++b) {
                const Agreement agreement = agreement_of(heard[a], heard[b]);
                EXPECT_GE(agreement.f_measure, 0.99) << name_of(style) << ' ' << a << ' ' << b;
                EXPECT_LE(agreement.median_shift, 0.0005) << name_of(style) << ' ' << a << ' ' << b;
            }
        }
    }
}

class OddSound : public ::testing::Test {
 protected:
    /// Scores a salsa after something was done to each sample (value, index).
    template <class Change>
    static test::BeatScore score_after(const Change& change) {
        GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 25.0);
        for (std::size_t i = 0; i < piece.samples.size(); ++i) {
            piece.samples[i] = change(piece.samples[i], i);
        }
        return test::score_beats(listen(piece), piece.beats, 6.0, 24.9);
    }
};

TEST_F(OddSound, a_constant_offset_does_not_matter) {
    EXPECT_GE(score_after([](float x, std::size_t) { return 0.4F + 0.5F * x; }).f_measure, 0.97);
}

TEST_F(OddSound, eight_bits_are_enough) {
    const auto score =
        score_after([](float x, std::size_t) { return std::round(x * 127.0F) / 127.0F; });
    EXPECT_GE(score.f_measure, 0.97);
}

TEST_F(OddSound, clipping_and_quiet_and_loud_levels_do_not_matter) {
    EXPECT_GE(score_after([](float x, std::size_t) {
                  return std::clamp(8.0F * x, -1.0F, 1.0F);
              }).f_measure,
              0.97);
    EXPECT_GE(score_after([](float x, std::size_t) { return 0.01F * x; }).f_measure, 0.97);
}

TEST_F(OddSound, a_bad_sample_now_and_then_does_not_matter) {
    const auto score = score_after([](float x, std::size_t i) {
        return i % 10'007 == 0 ? std::numeric_limits<float>::quiet_NaN() : x;
    });
    EXPECT_GE(score.f_measure, 0.97);
}

TEST_F(OddSound, a_full_scale_square_wave_has_no_beat) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    std::vector<float> square(48'000 * 20);
    for (std::size_t i = 0; i < square.size(); ++i) {
        square[i] = i / 100 % 2 == 0 ? 1.0F : -1.0F;
    }
    Collect collect;
    analyzer.process(square, collect);
    for (const MusicState& state : collect.states) {
        ASSERT_TRUE(std::isfinite(state.onset_strength) && std::isfinite(state.loudness_lufs));
        ASSERT_LE(state.grid.confidence, 0.3F) << state.hop;
    }
}

/// Keeps only what is asked of: no memory for hours.
class CountBeats final : public MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        beats += state.has_beat ? 1 : 0;
        hops += 1;
    }
    int beats = 0;
    int hops = 0;
};

TEST(LongSound, ten_minutes_of_silence_have_no_beat) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    CountBeats count;
    const std::vector<float> second(48'000);
    for (int i = 0; i < 600; ++i) {
        analyzer.process(second, count);
    }
    EXPECT_EQ(count.beats, 0);
    EXPECT_GE(count.hops, 59'990);
}

TEST(LongSound, ten_minutes_of_music_do_not_drift) {
    const GeneratedMusic piece = music(Style::montuno, {{0.0, 180.0}}, 600.0, 32'000);
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped(piece.rate)));
    Collect collect(65'000);
    {
        raks::test::RealtimeScope scope;
        analyzer.process(piece.samples, collect);
        EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    }
    for (const double from : {10.0, 300.0, 500.0}) {
        const auto score = test::score_beats(collect.states, piece.beats, from, from + 90.0);
        EXPECT_GE(score.f_measure, 0.98) << "from " << from << " s";
        EXPECT_LE(std::abs(score.median_error), 0.010) << "from " << from << " s";
    }
}

}  // namespace
}  // namespace raks::audio
