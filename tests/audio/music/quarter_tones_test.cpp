#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "audio/music/instruments/synthesizers.hpp"
#include "audio/music/score/arrangement.hpp"
#include "tests/audio/music/shipped_styles.hpp"

namespace raks::audio {
namespace {

/// Power of a tone in some samples (Goertzel).
double power_at(double hertz, int rate, const std::vector<float>& samples) {
    const double angle = 2.0 * M_PI * hertz / rate;
    double re = 0.0;
    double im = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double x = static_cast<double>(samples[i]);
        re += x * std::cos(angle * static_cast<double>(i));
        im += x * std::sin(angle * static_cast<double>(i));
    }
    return re * re + im * im;
}

TEST(QuarterTones, an_oud_plucks_between_the_keys) {
    constexpr int kRate = 16'000;
    OudNote note{.length = 1.5, .hertz = 220.0 * std::exp2(0.5 / 12.0)};
    const auto samples = play_oud({&note, 1}, kRate, 2 * kRate);
    ASSERT_EQ(samples.size(), 2U * kRate);
    const double between = power_at(220.0 * std::exp2(0.5 / 12.0), kRate, samples);
    EXPECT_GT(between, 5.0 * power_at(220.0, kRate, samples));
    EXPECT_GT(between, 5.0 * power_at(220.0 * std::exp2(1.0 / 12.0), kRate, samples));
    EXPECT_FLOAT_EQ(
        std::abs(*std::max_element(samples.begin(),
                                   samples.end(),
                                   [](float a, float b) { return std::abs(a) < std::abs(b); })),
        1.0F);
    note.time = 5.0;
    EXPECT_LT(power_at(226.4, kRate, play_oud({&note, 1}, kRate, kRate)), 1e-6) << "after the end";
}

TEST(QuarterTones, are_in_oriental_melodies_where_asked_for_and_nowhere_else) {
    int with_quarters = 0;
    int melodies = 0;
    const StyleBook& book = shipped_styles();
    for (const RhythmStyle& style : book.rhythms) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            Dice plain_dice(5, seed);
            Dice dice(5, seed);
            const Score plain = arrange(book, style, 32, plain_dice);
            const Score score = arrange(book, style, 32, dice, OrientalScales::quarter_tones);
            const auto is_between = [](const ScoreNote& note) { return note.cents != 0.0; };
            ASSERT_TRUE(std::none_of(plain.notes.begin(), plain.notes.end(), is_between));
            const auto quarters = std::count_if(score.notes.begin(), score.notes.end(), is_between);
            if (!style.label || style.label->dance != "belly") {
                ASSERT_EQ(quarters, 0) << style.name;
                ASSERT_EQ(score.notes.size(), plain.notes.size()) << style.name;
                continue;
            }
            const auto melody =
                std::count_if(score.notes.begin(), score.notes.end(), [](const ScoreNote& note) {
                    return note.channel == kMelodyChannel;
                });
            melodies += melody > 0 ? 1 : 0;
            with_quarters += quarters > 0 ? 1 : 0;
            for (const ScoreNote& note : score.notes) {
                ASSERT_TRUE(note.cents == 0.0 || note.cents == 50.0);
                ASSERT_TRUE(note.cents == 0.0 || note.channel >= kMelodyChannel);
            }
        }
    }
    EXPECT_GT(with_quarters, melodies / 3);
    EXPECT_LT(with_quarters, melodies) << "hijaz and nahawand are played, too";
}

}  // namespace
}  // namespace raks::audio
