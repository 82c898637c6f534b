#include "audio/beat/beat_change.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

using Bands = std::array<float, OnsetDetector::kMelBands>;

/// The changes told at each beat of music whose low bands move on every `beats_per_chord` beats.
std::vector<float> changes(int beats, int beats_per_chord, float level) {
    const CounterRandom random(5);
    BeatChange meter;
    std::vector<float> told;
    std::uint64_t draw = 0;
    for (int beat = 0; beat < beats; ++beat) {
        told.push_back(meter.next_beat());
        const auto chord = static_cast<std::size_t>(beat / beats_per_chord % 3);
        for (int hop = 0; hop < 50; ++hop) {
            Bands bands{};
            for (std::size_t i = 0; i < bands.size(); ++i) {
                const bool sounds = i < 12 && i % 3 == chord;
                const auto noise = static_cast<float>(0.2 * random.uniform(draw++));
                bands[i] = level * ((sounds ? 2.0F : 0.5F) + noise);
            }
            meter.add(bands);
        }
    }
    return told;
}

TEST(BeatChange, is_largest_where_the_chord_changes) {
    const std::vector<float> told = changes(64, 4, 1.0F);
    for (std::size_t beat = 16; beat < told.size(); ++beat) {
        const bool was_change = (beat - 1) % 4 == 0;  // told one beat later
        EXPECT_EQ(told[beat] > 1.0F, was_change) << beat << ": " << told[beat];
    }
}

TEST(BeatChange, does_not_depend_on_the_level) {
    const std::vector<float> loud = changes(32, 4, 100.0F);
    const std::vector<float> soft = changes(32, 4, 1e-4F);
    for (std::size_t beat = 0; beat < loud.size(); ++beat) {
        EXPECT_NEAR(loud[beat], soft[beat], 0.02F) << beat;
    }
}

TEST(BeatChange, tells_nothing_of_what_was_not_heard) {
    BeatChange meter;
    for (int beat = 0; beat < 8; ++beat) {
        EXPECT_EQ(meter.next_beat(), 0.0F);
    }
    const Bands silence{};
    for (int beat = 0; beat < 32; ++beat) {
        meter.add(silence);
        EXPECT_EQ(meter.next_beat(), 0.0F);
    }
}

}  // namespace
}  // namespace raks::audio
