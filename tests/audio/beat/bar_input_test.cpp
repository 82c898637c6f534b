#include "audio/beat/network/bar_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "audio/beat/network/bar_network.hpp"
#include "base/random.hpp"
#include "models/recurrent_network.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using Bands = std::array<float, BarInput::kBands>;
constexpr int kHops = 48;  // a beat

/// One beat in which every band has magnitude `level`, and `bands` on its second quarter.
BarInput::Frame beat(BarInput& input, float level, const Bands& bands, float gain = 1.0F) {
    for (int hop = 0; hop < kHops; ++hop) {
        Bands heard = bands;
        if (hop / (kHops / 4) != 1) {
            heard.fill(level);
        }
        for (float& value : heard) {
            value *= gain;
        }
        input.add_hop(heard, hop / static_cast<double>(kHops), {0.5F, 0.25F, 0.1F});
    }
    return input.next_beat();
}

Bands low_bands(float low) {
    Bands bands{};
    bands.fill(1.0F);
    std::fill_n(bands.begin(), 6, low);
    return bands;
}

TEST(BarInput, gain_does_not_matter) {
    BarInput loud;
    BarInput soft;
    const CounterRandom random(3);
    for (std::uint64_t n = 0; n < 12; ++n) {
        const Bands bands = low_bands(static_cast<float>(1.0 + 5.0 * random.uniform(n)));
        const auto a = beat(loud, 1.0F, bands);
        const auto b = beat(soft, 1.0F, bands, 0.03F);
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_NEAR(a[i], b[i], 1e-3F) << i;
        }
    }
}

TEST(BarInput, a_bass_note_shows_in_its_quarter_and_band_alone) {
    BarInput input;
    for (int n = 0; n < 20; ++n) {
        beat(input, 1.0F, low_bands(1.0F));
    }
    const auto frame = beat(input, 1.0F, low_bands(8.0F));
    for (std::size_t quarter = 0; quarter < BarInput::kQuarters; ++quarter) {
        for (std::size_t group = 0; group < BarInput::kGroups; ++group) {
            const float value = frame[quarter * BarInput::kGroups + group];
            if (quarter == 1 && group < 2) {
                EXPECT_GT(value, 1.0F) << group;
            } else {
                EXPECT_LT(value, 0.05F) << quarter << " " << group;
            }
        }
    }
}

TEST(BarInput, changes_tell_what_is_new_in_a_beat_and_nothing_of_what_repeats) {
    BarInput input;
    for (int n = 0; n < 30; ++n) {
        beat(input, 1.0F, low_bands(2.0F));
    }
    constexpr std::size_t kChanges = BarInput::kQuarters * BarInput::kGroups;
    const auto same = beat(input, 1.0F, low_bands(2.0F));
    const auto other = beat(input, 1.0F, low_bands(8.0F));
    EXPECT_NEAR(same[kChanges], 0.0F, 1e-3F);
    EXPECT_GT(other[kChanges], 0.5F);
    EXPECT_NEAR(other[kChanges + 6], 0.0F, 0.01F);
}

TEST(BarInput, tells_evidence_and_tempo) {
    BarInput input;
    const auto frame = beat(input, 1.0F, low_bands(1.0F));
    const float* const rest = &frame[BarInput::kSize - 4];
    EXPECT_FLOAT_EQ(rest[0], 1.0F);
    EXPECT_FLOAT_EQ(rest[1], 1.0F);
    EXPECT_FLOAT_EQ(rest[2], 0.2F);
    EXPECT_FLOAT_EQ(rest[3], std::log2(48.0F / 50.0F));
}

TEST(BarInput, silence_missing_hops_and_reset_stay_finite_without_allocation) {
    auto network = std::make_shared<BarNetwork>(8, 1);
    BarNetworkStream listener(network);
    BarInput input;
    const Bands silence{};
    test::RealtimeScope scope;
    for (int n = 0; n < 20; ++n) {
        if (n % 3 != 0) {
            input.add_hop(silence, 1.5, {});
        }
        for (const float value : input.next_beat()) {
            EXPECT_TRUE(std::isfinite(value));
        }
    }
    input.reset();
    const BarEvidence heard = listener.next(input.next_beat());
    EXPECT_FLOAT_EQ(heard.first + heard.middle + heard.other, 1.0F);
    listener.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::audio
