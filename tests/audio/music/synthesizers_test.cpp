#include "audio/music/instruments/synthesizers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "audio/music/instruments/drawn_drum.hpp"
#include "audio/music/instruments/drawn_tone.hpp"

namespace raks::audio {
namespace {

constexpr int kRate = 44'100;

float peak_of(const std::vector<float>& samples) {
    float peak = 0.0F;
    for (const float sample : samples) {
        peak = std::max(peak, std::abs(sample));  // NaN would stay: expected finite beside it
    }
    return peak;
}

bool is_finite(const std::vector<float>& samples) {
    return std::all_of(
        samples.begin(), samples.end(), [](float sample) { return std::isfinite(sample); });
}

/// Power at one frequency.
double power_at(double hertz, const std::vector<float>& samples) {
    std::complex<double> sum;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double phase = 2.0 * std::numbers::pi * hertz * static_cast<double>(i) / kRate;
        sum += static_cast<double>(samples[i]) * std::polar(1.0, -phase);
    }
    return std::norm(sum);
}

/// A note of each of three instruments and three drums.
Performance small_band() {
    Performance band;
    band.seconds = 1.5;
    for (int instrument = 0; instrument < 3; ++instrument) {
        band.notes.push_back(
            {0.2 * instrument, 0.3, instrument, 60 + instrument, 8 * instrument, 100, 0.0});
        band.notes.push_back(
            {0.2 * instrument, 0.1, kDrumChannel, 36 + 2 * instrument, 0, 100, 0.0});
    }
    return band;
}

TEST(DrawnDrum, every_key_of_the_percussion_map_sounds_and_ends) {
    for (int key = 27; key <= 87; ++key) {
        Dice dice(1, static_cast<std::uint64_t>(key));
        const std::vector<float> stroke = strike(draw_drum(key, dice), kRate);
        ASSERT_TRUE(is_finite(stroke)) << key;
        EXPECT_NEAR(peak_of(stroke), 1.0, 1e-6) << key;
        EXPECT_LT(stroke.size(), 4U * kRate) << key;
        EXPECT_LT(std::abs(stroke.back()), 0.05F) << key;
    }
}

TEST(DrawnTone, a_note_begins_when_it_should_and_has_its_pitch) {
    constexpr double kHertz = 440.0;
    for (int program = 0; program < 128; program += 4) {
        Dice dice(2, static_cast<std::uint64_t>(program));
        const DrawnTone tone = draw_tone(program, dice);
        std::vector<float> samples(kRate);
        add_note(tone, {0.25, 0.6, kHertz, 1.0}, kRate, samples);
        ASSERT_TRUE(is_finite(samples)) << program;
        EXPECT_EQ(peak_of({samples.begin(), samples.begin() + kRate / 4}), 0.0F) << program;
        // Partials lie at multiples of the pitch, or of its half where a sine at half modulates.
        double partials = 0.0;
        double between = 0.0;
        const bool is_harmonic = tone.oscillator != DrawnTone::Oscillator::modulated;
        for (int partial = 1; partial <= 4; ++partial) {
            partials += power_at(partial * kHertz, samples);
            between += power_at((partial + 0.37) * kHertz, samples);
        }
        EXPECT_GT(partials, 0.0) << program;
        if (is_harmonic && tone.breath == 0.0) {
            EXPECT_GT(partials, 20.0 * between) << program;
        }
    }
}

TEST(Synthesizers, all_or_none_of_the_notes_are_taken_as_asked) {
    Dice dice(3, 1);
    Performance all = small_band();
    const std::vector<float> played = play_synthesizers(1.0, kRate, all, dice);
    EXPECT_TRUE(all.notes.empty());
    EXPECT_EQ(played.size(), static_cast<std::size_t>(1.5 * kRate));
    EXPECT_NEAR(peak_of(played), 0.7, 1e-6);
    Performance none = small_band();
    EXPECT_TRUE(play_synthesizers(0.0, kRate, none, dice).empty());
    EXPECT_EQ(none.notes.size(), small_band().notes.size());
}

TEST(Synthesizers, an_instrument_is_taken_whole_and_the_rest_left_in_order) {
    for (std::uint64_t number = 0; number < 20; ++number) {
        Dice dice(4, number);
        Performance twice = small_band();
        for (const PlayedNote& note : small_band().notes) {
            twice.notes.push_back(note);
        }
        static_cast<void>(play_synthesizers(0.5, kRate, twice, dice));
        ASSERT_EQ(twice.notes.size() % 2, 0U);
        const std::size_t half = twice.notes.size() / 2;
        for (std::size_t i = 0; i < half; ++i) {
            EXPECT_EQ(twice.notes[i].key, twice.notes[half + i].key);
            EXPECT_EQ(twice.notes[i].channel, twice.notes[half + i].channel);
        }
    }
}

TEST(Synthesizers, the_same_dice_give_the_same_bits_and_others_another_sound) {
    const auto play = [](std::uint64_t number) {
        Dice dice(5, number);
        Performance band = small_band();
        return play_synthesizers(1.0, kRate, band, dice);
    };
    EXPECT_EQ(play(1), play(1));
    EXPECT_NE(play(1), play(2));
}

}  // namespace
}  // namespace raks::audio
