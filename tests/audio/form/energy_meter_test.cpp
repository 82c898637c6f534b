#include "audio/form/energy_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace raks::audio {
namespace {

/// A band at a level in dB over -20 dBFS.
HopSound sound_at(float level) {
    HopSound sound;
    sound.level = -20.0F + level;
    sound.bands = {25.0F + level, 22.0F + level, 8.0F + level};
    sound.novelty = {0.1F, 0.1F, 0.2F};
    return sound;
}

/// The energies of music whose level at each hop is given; NaN: nothing sounds.
std::vector<MusicEnergy> energies_of(int hops, const std::function<float(int)>& level) {
    EnergyMeter meter;
    std::vector<MusicEnergy> energies;
    for (int hop = 0; hop < hops; ++hop) {
        const float now = level(hop);
        energies.push_back(std::isnan(now) ? meter.advance(HopSound(), true)
                                           : meter.advance(sound_at(now), false));
    }
    return energies;
}

TEST(EnergyMeter, steady_music_is_as_usual) {
    const auto energies = energies_of(3'000, [](int) { return 0.0F; });
    for (std::size_t i = 400; i < energies.size(); ++i) {
        ASSERT_NEAR(energies[i].now, 0.5F, 0.02F);
        ASSERT_NEAR(energies[i].lately, 0.5F, 0.03F);
        ASSERT_NEAR(energies[i].longer, 0.5F, 0.03F);
    }
}

TEST(EnergyMeter, follows_the_loudness_of_a_song_over_its_own_range) {
    // 20 s in each third: usual, calm, full.
    const auto energies = energies_of(6'000, [](int hop) {
        return hop < 2'000 ? 0.0F : hop < 4'000 ? -8.0F : 4.0F;
    });
    EXPECT_LT(energies[2'100].now, 0.3F) << "within a second";
    EXPECT_LT(energies[2'450].lately, 0.3F) << "within five";
    EXPECT_GT(energies[2'450].longer, 0.4F);
    EXPECT_GT(energies[4'100].now, 0.75F);
    EXPECT_GT(energies[4'450].lately, 0.75F);
}

TEST(EnergyMeter, falls_to_nothing_within_0_3_s_of_silence_and_is_back_as_soon) {
    const auto energies = energies_of(
        3'000, [](int hop) { return hop >= 2'000 && hop < 2'200 ? std::nanf("") : 0.0F; });
    EXPECT_LT(energies[2'020].now, 0.01F);
    EXPECT_LT(energies[2'199].lately, energies[1'999].lately);
    EXPECT_GT(energies[2'220].now, 0.4F);
}

TEST(EnergyMeter, twenty_decibels_less_are_the_same_energies) {
    const auto level = [](int hop) {
        return 6.0F * std::sin(0.003F * static_cast<float>(hop)) +
               3.0F * std::sin(0.2F * static_cast<float>(hop));
    };
    const auto loud = energies_of(4'000, level);
    const auto soft = energies_of(4'000, [&](int hop) { return level(hop) - 20.0F; });
    for (std::size_t i = 0; i < loud.size(); ++i) {
        ASSERT_NEAR(loud[i].now, soft[i].now, 1e-3F);
        ASSERT_NEAR(loud[i].lately, soft[i].lately, 1e-3F);
        ASSERT_NEAR(loud[i].longer, soft[i].longer, 1e-3F);
    }
}

}  // namespace
}  // namespace raks::audio
