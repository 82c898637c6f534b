#include "motion/dance/dynamics/energy_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::motion {
namespace {

TEST(EnergyRange, holds_all_energies_likely_before_anything_is_heard) {
    const EnergyRange range;
    for (const double energy : {0.0, 0.25, 0.5, 1.0}) {
        EXPECT_NEAR(range.share_below(energy), energy, 1e-6);
    }
}

TEST(EnergyRange, spreads_what_music_gives_over_all_shares) {
    EnergyRange range;
    for (int hop = 0; hop < 6'000; ++hop) {
        range.hear(0.5F + 0.1F * std::sin(0.01F * static_cast<float>(hop)));
    }
    EXPECT_LT(range.share_below(0.4), 0.2);
    EXPECT_NEAR(range.share_below(0.5), 0.5, 0.08);
    EXPECT_GT(range.share_below(0.6), 0.8);
    double last = 0.0;
    for (double energy = 0.0; energy <= 1.0; energy += 0.01) {
        const double share = range.share_below(energy);
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
    }
}

TEST(EnergyRange, puts_steady_music_in_the_middle) {
    EnergyRange range;
    for (int hop = 0; hop < 6'000; ++hop) {
        range.hear(0.7F);
    }
    EXPECT_NEAR(range.share_below(0.7), 0.5, 0.15);
}

TEST(EnergyRange, forgets) {
    EnergyRange range;
    for (int hop = 0; hop < 6'000; ++hop) {
        range.hear(0.9F);
    }
    for (int hop = 0; hop < 60'000; ++hop) {
        range.hear(0.2F);
    }
    EXPECT_GT(range.share_below(0.5), 0.9);
}

}  // namespace
}  // namespace raks::motion
