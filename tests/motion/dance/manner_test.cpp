#include "motion/dance/dynamics/manner.hpp"

#include <gtest/gtest.h>

namespace raks::motion::manner_test {
namespace {

MusicState giving(float energy) {
    MusicState music;
    music.energy = {energy, energy, energy};
    return music;
}

MannerOfMusic after(float energy, int hops) {
    MannerOfMusic manner;
    for (int hop = 0; hop < hops; ++hop) {
        manner.advance(giving(energy));
    }
    return manner;
}

TEST(Manner, is_as_learnt_while_the_music_gives_what_it_usually_does) {
    const Manner usual = after(0.6F, 500).manner();
    EXPECT_EQ(usual.body, 1.0F);
    EXPECT_EQ(usual.arms, 1.0F);
    EXPECT_EQ(usual.bend, 0.0F);
    EXPECT_TRUE(Manner().is_as_learnt());
}

TEST(Manner, is_small_in_calm_music_and_large_in_full_one) {
    const Manner calm = after(0.0F, 500).manner();
    const Manner full = after(1.0F, 500).manner();
    EXPECT_NEAR(calm.arms, 0.55F, 0.01F);
    EXPECT_GE(full.arms, 1.05F);
    EXPECT_LE(full.arms, 1.25F);
    EXPECT_LT(calm.body, 0.6F);
    EXPECT_GT(full.bend, calm.bend) << "lower";
    EXPECT_GT(full.sharpness, calm.sharpness + 0.3F);
}

TEST(Manner, grows_faster_than_it_shrinks) {
    MannerOfMusic grows = after(0.0F, 500);
    MannerOfMusic shrinks = after(0.6F, 500);
    for (int hop = 0; hop < 25; ++hop) {
        grows.advance(giving(0.6F));
        shrinks.advance(giving(0.0F));
    }
    EXPECT_GT(grows.manner().arms - 0.55F, 1.0F - shrinks.manner().arms);
}

TEST(Manner, is_larger_after_a_drop_than_after_the_same_music_without_one) {
    MannerOfMusic manner = after(0.8F, 500);
    const float before = manner.manner().arms;
    MusicState drop = giving(0.8F);
    drop.event.kind = MusicEvent::Kind::drop;
    manner.hear(drop.event);
    manner.advance(drop);
    for (int hop = 0; hop < 100; ++hop) {
        manner.advance(giving(0.8F));
    }
    EXPECT_GT(manner.manner().arms, before + 0.1F);
    for (int hop = 0; hop < 4000; ++hop) {
        manner.advance(giving(0.8F));
    }
    EXPECT_NEAR(manner.manner().arms, before, 0.01F) << "it wears off";
}

TEST(Manner, steps_change_only_with_the_way_of_their_own_foot) {
    MannerOfMusic manner = after(0.0F, 500);
    EXPECT_EQ(manner.manner().steps[0], 1.0F) << "it stands still";
    for (int hop = 0; hop < 50; ++hop) {
        manner.swing(Side::left, 0.02F);
    }
    EXPECT_NEAR(manner.manner().steps[0], 0.52F, 0.01F);
    EXPECT_EQ(manner.manner().steps[1], 1.0F);
}

TEST(Sharpened, waits_on_beats_and_hurries_between_them) {
    for (const float sharpness : {0.0F, 0.35F, 0.7F}) {
        const auto slope = [&](double beat) {
            return (sharpened(beat + 1e-4, sharpness) - sharpened(beat - 1e-4, sharpness)) / 2e-4;
        };
        EXPECT_NEAR(slope(3.0), 1.0 - static_cast<double>(sharpness), 1e-3);
        EXPECT_NEAR(slope(3.5), 1.0 + static_cast<double>(sharpness), 1e-3);
        EXPECT_NEAR(sharpened(5.0, sharpness), 5.0, 1e-9) << "on the beat it is where it was";
        for (double beat = 0.0; beat < 2.0; beat += 0.05) {
            EXPECT_LE(std::abs(sharpened(beat, sharpness) - beat), 0.16);
            EXPECT_GT(slope(beat), 0.0) << "never backward";
        }
    }
}

}  // namespace
}  // namespace raks::motion::manner_test
