#include "audio/form/last_chord.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace raks::audio {
namespace {

/// The end of music whose onsets and level at each hop are given.
HopIndex end_of(const std::function<float(HopIndex)>& peak,
                const std::function<float(HopIndex)>& level,
                HopIndex hops) {
    LastChord chord;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        HopSound sound;
        sound.level = level(hop);
        chord.advance(hop, sound, peak(hop));
    }
    return chord.hop();
}

TEST(LastChord, is_not_what_crackles_in_its_decay) {
    // The chord at 30 s rings for 12 s, with small onsets now and then.
    const auto peak = [](HopIndex hop) {
        return hop <= 3'000 ? (hop % 50 == 0 ? 0.8F : 0.0F) : hop % 170 == 0 ? 0.15F : 0.0F;
    };
    const auto level = [](HopIndex hop) { return hop <= 3'000 ? -10.0F : -15.0F; };
    EXPECT_EQ(end_of(peak, level, 4'200), 3'000);
}

TEST(LastChord, of_a_fade_out_is_where_it_is_no_longer_heard) {
    // From 30 s on the beats become softer, but go on.
    const auto strength = [](HopIndex hop) {
        return hop <= 3'000 ? 0.8F : 0.8F - 0.8F * static_cast<float>(hop - 3'000) / 1'000.0F;
    };
    const auto peak = [&](HopIndex hop) { return hop % 50 == 0 ? strength(hop) : 0.0F; };
    // By 4 dB a second, until it is cut off after 8 s.
    const auto level = [](HopIndex hop) {
        return hop > 3'800
                   ? -120.0F
                   : -10.0F - 0.04F * static_cast<float>(std::max<HopIndex>(0, hop - 3'000));
    };
    EXPECT_EQ(end_of(peak, level, 4'000), 3'800);
}

TEST(LastChord, is_0_without_an_onset) {
    EXPECT_EQ(end_of([](HopIndex) { return 0.0F; }, [](HopIndex) { return -120.0F; }, 500), 0);
}

}  // namespace
}  // namespace raks::audio
