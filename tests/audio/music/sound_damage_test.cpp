#include "audio/music/damage/sound_damage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "audio/io/lossy_codec.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

double rms_of(const std::vector<float>& samples) {
    double sum = 0.0;
    for (const float sample : samples) {
        sum += static_cast<double>(sample) * static_cast<double>(sample);
    }
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

TEST(SoundDamage, does_what_it_says) {
    constexpr int kRate = 16'000;
    const auto tone = [](double hertz) {
        std::vector<float> samples(16'000);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] =
                static_cast<float>(std::sin(2.0 * M_PI * hertz * static_cast<double>(i) / kRate));
        }
        return samples;
    };
    std::vector<float> quiet = tone(500.0);
    ASSERT_TRUE(damage(Damage::quieter_12_db, kRate, quiet));
    EXPECT_NEAR(rms_of(quiet), std::sqrt(0.5) * std::pow(10.0, -0.6), 1e-3);
    std::vector<float> low = tone(1'000.0);
    std::vector<float> high = tone(7'000.0);
    ASSERT_TRUE(damage(Damage::low_pass_4_khz, kRate, low));
    ASSERT_TRUE(damage(Damage::low_pass_4_khz, kRate, high));
    EXPECT_NEAR(rms_of(low), std::sqrt(0.5), 0.01);
    EXPECT_LT(rms_of(high), 0.03);
    std::vector<float> noisy = tone(500.0);
    ASSERT_TRUE(damage(Damage::noise_10_db, kRate, noisy));
    const std::vector<float> clean = tone(500.0);
    for (std::size_t i = 0; i < noisy.size(); ++i) {
        noisy[i] -= clean[i];
    }
    EXPECT_NEAR(20.0 * std::log10(rms_of(clean) / rms_of(noisy)), 10.0, 0.2);
    std::vector<float> room(16'000);
    room[0] = 1.0F;
    ASSERT_TRUE(damage(Damage::room_600_ms, kRate, room));
    const auto energy = [&](std::size_t from, std::size_t to) {
        return rms_of({room.begin() + static_cast<std::ptrdiff_t>(from),
                       room.begin() + static_cast<std::ptrdiff_t>(to)});
    };
    // 60 dB in 0.6 s: 30 dB between two spans 0.3 s apart.
    EXPECT_NEAR(20.0 * std::log10(energy(800, 3'200) / energy(5'600, 8'000)), 30.0, 2.0);
}

TEST(SoundDamage, every_third_copy_of_a_recording_is_in_a_room_and_nothing_else) {
    constexpr int kRate = 44'100;
    std::vector<float> click(2 * kRate);
    click[0] = 1.0F;
    SoundEffects steady;
    steady.leave_out(SoundEffect::speed);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Dice dice(1, seed);
        std::vector<float> heard = click;
        ASSERT_TRUE(alter_recording(kRate, 3, heard, dice, steady));
        const double direct = static_cast<double>(heard[0]);
        heard[0] = 0.0F;
        const double echoes = rms_of(heard) * std::sqrt(static_cast<double>(heard.size()));
        EXPECT_GE(direct, 0.3);
        EXPECT_LE(direct, 0.7);
        EXPECT_NEAR(direct + echoes, 1.0, 0.05);  // two may fall on one sample
        const auto after = heard.begin() + static_cast<std::ptrdiff_t>(1.2 * kRate) + 1;
        EXPECT_TRUE(std::all_of(after, heard.end(), [](float sample) { return sample == 0.0F; }));
    }
}

std::vector<float> clicks_and_tone(int rate, double seconds) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double at = static_cast<double>(i) / rate;
        const double since = std::fmod(at, 0.25);
        samples[i] = static_cast<float>(0.2 * std::sin(2.0 * M_PI * 440.0 * at) +
                                        0.6 * std::exp(-since * 60.0) *
                                            std::sin(2.0 * M_PI * 1'800.0 * since));
    }
    return samples;
}

/// By how many samples `b` lies behind `a`: where they agree best, and how well (1: the same).
std::pair<int, double> shift_between(const std::vector<float>& a, const std::vector<float>& b) {
    std::pair<int, double> best{0, -1.0};
    constexpr int kMost = 3'000;
    for (int shift = -kMost; shift <= kMost; ++shift) {
        double product = 0.0;
        double power_a = 1e-9;
        double power_b = 1e-9;
        for (std::size_t i = kMost; i + kMost < a.size(); i += 3) {
            const auto x = static_cast<double>(a[i]);
            const auto y =
                static_cast<double>(b[static_cast<std::size_t>(static_cast<int>(i) + shift)]);
            product += x * y;
            power_a += x * x;
            power_b += y * y;
        }
        const double likeness = product / std::sqrt(power_a * power_b);
        best = likeness > best.second ? std::pair{shift, likeness} : best;
    }
    return best;
}

TEST(SoundDamage, lossy_codecs_keep_length_and_time_and_repeat) {
    for (const int rate : {44'100, 32'000, 48'000}) {
        const std::vector<float> clean = clicks_and_tone(rate, 0.8);
        for (const LossyCodec codec : {LossyCodec::mp3, LossyCodec::opus}) {
            for (const int bits : {24'000, 64'000}) {
                std::vector<float> coded = clean;
                ASSERT_TRUE(pass_lossy_codec(codec, rate, bits, coded));
                std::vector<float> again = clean;
                ASSERT_TRUE(pass_lossy_codec(codec, rate, bits, again));
                EXPECT_EQ(coded, again);
                ASSERT_EQ(coded.size(), clean.size());
                const auto [shift, likeness] = shift_between(clean, coded);
                EXPECT_LT(std::abs(shift), rate / 1'000) << rate << ' ' << bits << ' ' << likeness;
                EXPECT_GT(likeness, 0.9) << rate << ' ' << bits;
                EXPECT_NE(coded, clean);
            }
        }
    }
}

TEST(SoundDamage, mp3_of_24_kbit_takes_the_treble) {
    constexpr int kRate = 44'100;
    std::vector<float> high(static_cast<std::size_t>(kRate));
    std::vector<float> low = high;
    for (std::size_t i = 0; i < high.size(); ++i) {
        const double at = 2.0 * M_PI * static_cast<double>(i) / kRate;
        high[i] = static_cast<float>(0.5 * std::sin(14'000.0 * at));
        low[i] = static_cast<float>(0.5 * std::sin(500.0 * at));
    }
    ASSERT_TRUE(damage(Damage::mp3_24_kbit, kRate, high));
    ASSERT_TRUE(damage(Damage::mp3_24_kbit, kRate, low));
    EXPECT_LT(rms_of(high), 0.02);
    EXPECT_NEAR(rms_of(low), 0.5 / std::sqrt(2.0), 0.03);
}

TEST(SoundDamage, a_codec_survives_odd_sounds) {
    for (const LossyCodec codec : {LossyCodec::mp3, LossyCodec::opus}) {
        for (const std::size_t size : {0U, 1U, 575U, 1'153U}) {
            std::vector<float> samples(size, 0.5F);
            ASSERT_TRUE(pass_lossy_codec(codec, 44'100, 32'000, samples));
            EXPECT_EQ(samples.size(), size);
        }
    }
    std::vector<float> samples(1'000, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(pass_lossy_codec(LossyCodec::mp3, 44'100, 64'000, samples));
    EXPECT_LT(rms_of(samples), 1e-3);
    EXPECT_FALSE(pass_lossy_codec(LossyCodec::opus, 44'100, 5'000'000, samples));
}

TEST(SoundDamage, effects_that_are_left_out_do_not_happen) {
    constexpr int kRate = 16'000;
    const std::vector<float> clean = clicks_and_tone(kRate, 0.5);
    SoundEffects none;
    SoundEffects gain_alone;
    for (std::size_t i = 0; i < std::size(kSoundEffectNames); ++i) {
        none.leave_out(static_cast<SoundEffect>(i));
        if (static_cast<SoundEffect>(i) != SoundEffect::gain) {
            gain_alone.leave_out(static_cast<SoundEffect>(i));
        }
    }
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        std::vector<float> samples = clean;
        Dice dice(1, seed);
        ASSERT_TRUE(augment_for_genre(kRate, samples, dice, none));
        EXPECT_EQ(samples, clean);
        Dice others(2, seed);
        ASSERT_TRUE(augment_for_genre(kRate, samples, others, gain_alone));
        const float gain = samples[100] / clean[100];
        for (std::size_t i = 0; i < samples.size(); i += 97) {
            ASSERT_NEAR(samples[i], gain * clean[i], 1e-5F);
        }
        std::vector<float> altered = clean;
        Dice all(3, seed);
        ASSERT_TRUE(augment_for_genre(kRate, altered, all));
        ASSERT_EQ(altered.size(), clean.size());
        ASSERT_LT(rms_of(altered), 10.0);
        changed += altered != clean ? 1 : 0;
    }
    EXPECT_EQ(changed, 30);
}

}  // namespace
}  // namespace raks::audio
