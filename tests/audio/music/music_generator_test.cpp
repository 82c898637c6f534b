#include "audio/music/generator/music_generator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace raks::audio {
namespace {

constexpr std::array kAllStyles{Style::clicks,
                                Style::drums,
                                Style::montuno,
                                Style::maqsum,
                                Style::four_on_the_floor,
                                Style::backbeat,
                                Style::boom_bap,
                                Style::oom_pah_pah};

GeneratedMusic make(const MusicPlan& plan) {
    auto music = generate(plan);
    EXPECT_TRUE(music) << music.error().message;
    return std::move(music).value();
}

TEST(MusicGenerator, beats_of_a_steady_tempo_lie_where_arithmetic_says) {
    const auto music = make({.style = Style::clicks,
                             .tempo = {{0.0, 150.0}},
                             .seconds = 10.0,
                             .first_beat_seconds = 0.3});
    ASSERT_EQ(music.beats.size(), 25U);  // 0.3 + 0.4 k < 10
    for (std::size_t k = 0; k < music.beats.size(); ++k) {
        EXPECT_NEAR(to_seconds(music.beats[k].time), 0.3 + 0.4 * static_cast<double>(k), 1e-9);
        EXPECT_EQ(music.beats[k].bar_position, static_cast<int>(k % 4) + 1);
    }
}

TEST(MusicGenerator, every_click_starts_within_one_sample_of_its_beat) {
    for (const int rate : {8'000, 44'100, 48'000, 192'000}) {
        const auto music = make({.style = Style::clicks,
                                 .tempo = {{0.0, 80.0}, {4.0, 170.0}, {4.0, 95.0}},
                                 .seconds = 8.0,
                                 .rate = SampleRate(rate),
                                 .channels = 1,
                                 .first_beat_seconds = 0.123});
        std::vector<std::int64_t> onsets;
        for (std::size_t i = 1; i < music.samples.size(); ++i) {
            if (std::abs(music.samples[i]) > 0.3F && music.samples[i - 1] == 0.0F) {
                onsets.push_back(static_cast<std::int64_t>(i));
            }
        }
        ASSERT_EQ(onsets.size(), music.beats.size()) << rate;
        for (std::size_t k = 0; k < onsets.size(); ++k) {
            const double exact = to_seconds(music.beats[k].time) * rate;
            EXPECT_NEAR(static_cast<double>(onsets[k]), exact, 0.51) << rate << " beat " << k;
        }
    }
}

TEST(MusicGenerator, the_same_plan_gives_the_same_bits_and_another_seed_others) {
    for (const Style style : kAllStyles) {
        MusicPlan plan{.style = style, .tempo = {{0, 120}, {6, 132}}, .seconds = 8.0};
        const auto first = make(plan);
        EXPECT_EQ(first.samples, make(plan).samples) << name_of(style);
        plan.seed = 2;
        const auto other = make(plan);
        EXPECT_EQ(first.beats.size(), other.beats.size());
        EXPECT_EQ(first.samples == other.samples, style == Style::clicks) << name_of(style);
    }
}

TEST(MusicGenerator, every_style_sounds_without_clipping_or_nan) {
    for (const Style style : kAllStyles) {
        for (const int rate : {8'000, 48'000}) {
            const auto music =
                make({.style = style, .seconds = 40.0, .rate = SampleRate(rate), .seed = 3});
            ASSERT_EQ(music.frames(), 40 * rate);
            double energy = 0.0;
            for (const float sample : music.samples) {
                ASSERT_TRUE(std::abs(sample) <= 1.0F) << name_of(style);  // false for NaN
                energy += static_cast<double>(sample) * static_cast<double>(sample);
            }
            const double rms = std::sqrt(energy / static_cast<double>(music.samples.size()));
            EXPECT_GT(rms, 0.03) << name_of(style);
            EXPECT_LT(rms, 0.35) << name_of(style);
        }
    }
}

TEST(MusicGenerator, silences_are_exactly_silent_and_entered_without_a_click) {
    for (const Style style : {Style::montuno, Style::four_on_the_floor, Style::maqsum}) {
        const auto music =
            make({.style = style, .seconds = 12.0, .silences = {{3.1, 5.0}, {8.0, 8.7}}});
        const auto frame = [&](double t) { return static_cast<std::size_t>(t * 48'000.0); };
        for (std::size_t i = 2 * frame(3.1); i < 2 * frame(5.0); ++i) {
            ASSERT_EQ(music.samples[i], 0.0F);
        }
        for (std::size_t i = 2 * frame(8.0); i < 2 * frame(8.7); ++i) {
            ASSERT_EQ(music.samples[i], 0.0F);
        }
        EXPECT_LT(std::abs(music.samples[2 * frame(3.1) - 2]), 0.01F);
        EXPECT_LT(std::abs(music.samples[2 * music.samples.size() / 2 - 1]), 0.01F);
        for (const ReferenceBeat& beat : music.beats) {
            const double t = to_seconds(beat.time);
            const bool is_inside = (t > 3.0999 && t < 4.9999) || (t > 7.9999 && t < 8.6999);
            EXPECT_EQ(beat.is_audible, !is_inside) << t;
        }
    }
}

TEST(MusicGenerator, energy_rises_at_the_beats_of_every_drummed_style) {
    // In the 20 ms after a beat there is, on average, more energy than in the 20 ms before it.
    for (const Style style : {Style::drums,
                              Style::montuno,
                              Style::maqsum,
                              Style::four_on_the_floor,
                              Style::backbeat,
                              Style::boom_bap,
                              Style::oom_pah_pah}) {
        const auto music =
            make({.style = style, .tempo = {{0, 120}}, .seconds = 20, .channels = 1});
        double before = 0.0;
        double after = 0.0;
        for (const ReferenceBeat& beat : music.beats) {
            const auto at = std::llround(to_seconds(beat.time) * 48'000.0);
            for (std::int64_t i = 0; i < 960; ++i) {
                if (at < 960 || at + 960 > music.frames()) {
                    continue;
                }
                const double b =
                    static_cast<double>(music.samples[static_cast<std::size_t>(at - 1 - i)]);
                const double a =
                    static_cast<double>(music.samples[static_cast<std::size_t>(at + i)]);
                before += b * b;
                after += a * a;
            }
        }
        EXPECT_GT(after, 1.5 * before) << name_of(style);
    }
}

TEST(MusicGenerator, a_waltz_counts_in_threes) {
    const auto music = make({.style = Style::oom_pah_pah, .tempo = {{0, 90}}, .seconds = 10});
    for (std::size_t i = 0; i < music.beats.size(); ++i) {
        EXPECT_EQ(music.beats[i].bar_position, static_cast<int>(i % 3) + 1);
    }
}

TEST(MusicGenerator, mono_is_the_average_of_the_two_sides) {
    MusicPlan plan{.style = Style::montuno, .seconds = 4.0};
    const auto stereo = make(plan);
    plan.channels = 1;
    EXPECT_EQ(stereo.mono(), make(plan).samples);
}

TEST(MusicGenerator, each_fault_of_a_plan_is_named) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const MusicPlan bad{.tempo = {{0.0, 5.0}, {-1.0, 100.0}},
                        .seconds = nan,
                        .rate = SampleRate(0),
                        .channels = 3,
                        .first_beat_seconds = -1.0,
                        .silences = {{2.0, 1.0}}};
    const auto music = generate(bad);
    ASSERT_FALSE(music);
    for (const char* part : {"tempo[0].bpm is 5",
                             "tempo[1].seconds",
                             "seconds is nan",
                             "rate is 0 Hz",
                             "channels is 3",
                             "first_beat_seconds",
                             "silences[0]"}) {
        EXPECT_THAT(music.error().message, ::testing::HasSubstr(part));
    }
    EXPECT_FALSE(generate({.tempo = {}}));
}

TEST(MusicGenerator, styles_are_known_by_name) {
    for (const Style style : kAllStyles) {
        EXPECT_EQ(style_from_name(name_of(style)).value(), style);
    }
    EXPECT_EQ(
        style_from_name("polka").error().message,
        "style \"polka\" is unknown; known: clicks, drums, montuno, maqsum, four-on-the-floor, "
        "backbeat, boom-bap, oom-pah-pah");
}

}  // namespace
}  // namespace raks::audio
