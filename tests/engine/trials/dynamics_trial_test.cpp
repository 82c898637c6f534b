#include "engine/trials/dynamics_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

DanceInfo dance_of(const std::string& style, double bpm) {
    DanceInfo dance;
    dance.name = "example";
    dance.style = style;
    dance.likely = Bpm(bpm);
    return dance;
}

TEST(DynamicsTrial, its_music_has_the_sections_of_the_schedule_at_any_tempo) {
    for (const auto& [style, bpm] : {std::pair{"montuno", 184.0},
                                     {"four-on-the-floor", 124.0},
                                     {"boom-bap", 92.0},
                                     {"oom-pah-pah", 140.0}}) {
        const audio::MusicPlan plan = contrast_music(dance_of(style, bpm), 1);
        const auto music = audio::generate(plan);
        ASSERT_TRUE(music) << music.error().message;
        ASSERT_EQ(music->sections.size(), 4U);
        const std::vector<double> starts{0.0, 20.0, 32.0, 34.0};
        const double bar =
            audio::beats_per_bar(plan.style) * dance_of(style, bpm).likely.seconds_per_beat();
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(to_seconds(music->sections[i].from), starts[i], 0.5 * bar + 0.4) << style;
        }
        EXPECT_NEAR(to_seconds(music->sections[3].from - music->sections[2].from), 2.0, 0.34)
            << style;
        EXPECT_NEAR(plan.seconds - to_seconds(music->sections[3].to), 14.0, 1e-6);
        // The drop lies on a count 1.
        const auto downbeat =
            std::find_if(music->beats.begin(), music->beats.end(), [&](const auto& beat) {
                return std::abs(to_seconds(beat.time - music->sections[3].from)) < 1e-6;
            });
        ASSERT_NE(downbeat, music->beats.end());
        EXPECT_EQ(downbeat->bar_position, 1) << style;
    }
}

TEST(DynamicsTrial, a_drawn_song_begins_after_two_seconds_and_has_a_drop_and_a_stop) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto music = audio::generate(song_music(dance_of("backbeat", 130.0), seed));
        ASSERT_TRUE(music) << music.error().message;
        EXPECT_NEAR(to_seconds(music->events.front().time), 2.0, 1e-9);
        for (const auto kind : {MusicEvent::Kind::drop, MusicEvent::Kind::stop}) {
            EXPECT_TRUE(std::any_of(music->events.begin(),
                                    music->events.end(),
                                    [&](const MusicEvent& event) { return event.kind == kind; }));
        }
    }
}

TEST(DynamicsTrial, loudness_of_a_sine_is_its_level_and_silence_lies_at_the_floor) {
    for (const int rate : {44'100, 48'000}) {
        std::vector<float> mono(static_cast<std::size_t>(2 * rate), 0.0F);
        for (std::size_t i = 0; i < mono.size() / 2; ++i) {
            mono[i] = static_cast<float>(
                0.1 * std::sin(2.0 * M_PI * 960.0 * static_cast<double>(i) / rate));
        }
        const auto loudness = loudness_by_frame(mono, SampleRate(rate));
        ASSERT_TRUE(loudness) << loudness.error().message;
        ASSERT_NEAR(static_cast<double>(loudness->size()), 120.0, 2.0);
        // 20 log10(0.1 / sqrt(2)); the resampler's pass band is even to a tenth of a decibel.
        EXPECT_NEAR((*loudness)[30], -23.01, 0.1);
        EXPECT_NEAR((*loudness)[100], -80.0, 0.01);
    }
}

}  // namespace
}  // namespace raks::engine
