#include "audio/beat/bar_belief.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

/// Hears `beats` beats from number `first` on; every `metre`-th, from `downbeat` on, sounds like a
/// downbeat.
void hear(BarBelief& bars, long first, int beats, int metre, long downbeat) {
    for (long number = first; number < first + beats; ++number) {
        bars.next_beat(number);
        bars.observe_downbeat((number - downbeat) % metre == 0 ? 0.5F : 0.2F);
    }
}

long place(const BarBelief& bars, long number) {
    const long beats = bars.beats_per_bar();
    return ((number - bars.origin()) % beats + beats) % beats;
}

TEST(BarBelief, finds_metre_and_downbeat_within_six_bars) {
    for (const int metre : {3, 4}) {
        for (int downbeat = 0; downbeat < metre; ++downbeat) {
            BarBelief bars;
            hear(bars, 0, 6 * metre, metre, downbeat);
            EXPECT_EQ(bars.beats_per_bar(), metre);
            EXPECT_EQ(place(bars, downbeat), 0) << "bars of " << metre;
        }
    }
}

TEST(BarBelief, confidence_grows_with_what_fits_and_is_low_without) {
    BarBelief bars;
    const float before = bars.confidence();
    hear(bars, 0, 40, 4, 1);
    EXPECT_LT(before, 0.5F);
    EXPECT_GT(bars.confidence(), 0.9F);
    BarBelief alike;
    for (long number = 0; number < 40; ++number) {
        alike.next_beat(number);
        alike.observe_downbeat(0.3F);
    }
    EXPECT_LT(alike.confidence(), 0.5F);
}

TEST(BarBelief, moves_to_another_place_when_the_music_does) {
    BarBelief bars;
    hear(bars, 0, 32, 4, 0);
    hear(bars, 32, 32, 4, 34);
    EXPECT_EQ(place(bars, 34), 0);
}

TEST(BarBelief, beats_that_were_not_heard_count_on) {
    BarBelief bars;
    hear(bars, 0, 32, 4, 0);
    bars.next_beat(35);
    EXPECT_EQ(place(bars, 36), 0);
}

TEST(BarBelief, what_the_user_says_is_held_whatever_is_heard) {
    BarBelief bars;
    hear(bars, 0, 16, 4, 0);
    bars.hold(17);
    hear(bars, 16, 40, 4, 0);
    EXPECT_EQ(place(bars, 17), 0);
    EXPECT_EQ(bars.confidence(), 1.0F);
}

TEST(BarBelief, no_allocation_and_no_lock) {
    BarBelief bars;
    raks::test::RealtimeScope scope;
    hear(bars, 0, 64, 3, 1);
    bars.recount(3);
    bars.reset();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

TEST(BarBelief,
     counts_fours_where_the_third_beat_sounds_like_the_first_but_changes_come_on_the_first) {
    BarBelief bars;
    for (long number = 0; number < 48; ++number) {
        bars.next_beat(number);
        bars.observe_downbeat(number % 2 == 1 ? 0.5F : 0.15F);
        bars.observe_change(number % 4 == 3 ? 1.5F : -0.5F);
    }
    EXPECT_EQ(bars.beats_per_bar(), 4);
    EXPECT_EQ((bars.origin() % 4 + 4) % 4, 3);
}

TEST(BarBelief, counts_twos_where_the_sound_changes_on_every_other_beat) {
    BarBelief bars;
    for (long number = 0; number < 48; ++number) {
        bars.next_beat(number);
        bars.observe_downbeat(number % 2 == 1 ? 0.5F : 0.15F);
        bars.observe_change(number % 2 == 1 ? 1.0F : -1.0F);
    }
    EXPECT_EQ(bars.beats_per_bar(), 2);
    EXPECT_EQ((bars.origin() % 2 + 2) % 2, 1);
}

TEST(BarBelief, believes_a_network_that_tells_first_and_middle) {
    for (const int metre : {2, 3, 4, 6}) {
        BarBelief bars;
        for (long number = 0; number < 10 * metre; ++number) {
            bars.next_beat(number);
            const long in_bar = (number - 1 + metre) % metre;
            const bool is_middle = metre >= 4 && in_bar == metre / 2;
            bars.observe_bar(in_bar == 0 ? BarEvidence{0.7F, 0.1F, 0.2F}
                             : is_middle ? BarEvidence{0.2F, 0.5F, 0.3F}
                                         : BarEvidence{0.1F, 0.05F, 0.85F});
        }
        EXPECT_EQ(bars.beats_per_bar(), metre);
        EXPECT_EQ(place(bars, 1), 0) << "bars of " << metre;
    }
}

}  // namespace
}  // namespace raks::audio

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

// Where a song begins is most likely a downbeat; music that says otherwise wins.
TEST(BarBelief, takes_the_first_beat_of_a_song_for_a_downbeat_until_it_hears_better) {
    for (long start = 0; start < 4; ++start) {
        BarBelief bars;
        for (long number = start; number < start + 5; ++number) {
            bars.next_beat(number);
        }
        bars.observe_start(start);
        EXPECT_EQ(place(bars, start), 0);
        EXPECT_EQ(bars.beats_per_bar(), 4);
        hear(bars, start + 5, 32, 4, start + 1);
        EXPECT_EQ(place(bars, start + 1), 0) << "it began with an upbeat";
    }
}

}  // namespace
}  // namespace raks::audio
