#include "training/networks/mel_augmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace raks::audio {
namespace {

using Bands = std::array<float, NetworkInput::kBands>;

/// One hop of sound in silence.
std::vector<float> click(std::size_t hops, std::size_t at) {
    std::vector<float> mel(hops * NetworkInput::kBands, 0.0F);
    std::fill_n(mel.begin() + static_cast<std::ptrdiff_t>(at * NetworkInput::kBands),
                NetworkInput::kBands,
                1.0F);
    return mel;
}

std::vector<Bands> heard(const std::vector<float>& mel, const MelAugmentation& augmentation) {
    std::vector<Bands> hops;
    augment_bands(mel,
                  augmentation,
                  mel.size() / NetworkInput::kBands,
                  nullptr,
                  [&](std::size_t, const Bands& bands) { hops.push_back(bands); });
    return hops;
}

double energy_of(const std::vector<Bands>& hops, std::size_t first) {
    double energy = 0.0;
    for (std::size_t t = first; t < hops.size(); ++t) {
        for (const float magnitude : hops[t]) {
            energy += static_cast<double>(magnitude) * static_cast<double>(magnitude);
        }
    }
    return energy / NetworkInput::kBands;
}

TEST(MelAugmentation, a_room_gives_back_its_share_of_the_energy_and_dies_away) {
    MelAugmentation augmentation = MelAugmentation::plain();
    augmentation.reverberation = 2.0F;
    augmentation.decay = 0.8F;
    const auto hops = heard(click(200, 10), augmentation);
    EXPECT_EQ(energy_of({hops.begin(), hops.begin() + 10}, 0), 0.0);
    EXPECT_NEAR(energy_of(hops, 0), 3.0, 1e-3);
    const float magnitude_kept = std::sqrt(0.8F);
    EXPECT_NEAR(hops[60][5] / hops[59][5], magnitude_kept, 1e-4);
}

TEST(MelAugmentation, drawn_rooms_die_away_within_a_second) {
    Dice dice(3, 4);
    for (int i = 0; i < 50; ++i) {
        MelAugmentation augmentation = MelAugmentation::plain();
        augmentation.enter_room(dice);
        const auto hops = heard(click(120, 10), augmentation);
        EXPECT_GT(hops[11][7], 0.0F);
        EXPECT_LT(hops[111][7], 1.01e-3F * hops[11][7]);
    }
}

TEST(MelAugmentation, muffled_music_loses_treble_alone) {
    Dice dice(5, 6);
    for (int i = 0; i < 50; ++i) {
        MelAugmentation augmentation = MelAugmentation::plain();
        augmentation.muffle(dice);
        EXPECT_EQ(augmentation.gain[13], 1.0F);
        EXPECT_LT(augmentation.gain[NetworkInput::kBands - 1], 0.9F);
        EXPECT_TRUE(std::is_sorted(augmentation.gain.rbegin(), augmentation.gain.rend()));
    }
}

}  // namespace
}  // namespace raks::audio
