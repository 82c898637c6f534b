#include "audio/form/pause_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace raks::audio {
namespace {

/// An event with the hop at which it was told.
struct Told {
    MusicEvent::Kind kind;
    HopIndex at;    // hop of its time
    HopIndex told;  // hop at which it became known
};

/// All events of music whose level at each hop is given.
std::vector<Told> events_of(HopIndex hops, const std::function<float(HopIndex)>& level) {
    PauseDetector detector;
    std::vector<Told> told;
    for (HopIndex hop = 0; hop < hops; ++hop) {
        const MusicEvent event = detector.advance(hop, level(hop), 50);
        if (event.kind != MusicEvent::Kind::none) {
            told.push_back({event.kind, event.time.time_since_epoch() / kHop, hop});
        }
    }
    return told;
}

/// Ripple of a band that plays on.
float playing(HopIndex hop) { return -20.0F + 4.0F * std::sin(0.7F * static_cast<float>(hop)); }

TEST(PauseDetector, a_cut_is_known_within_120_ms_and_an_entry_within_20) {
    const auto told = events_of(
        1'400, [](HopIndex hop) { return hop >= 1'000 && hop < 1'200 ? -120.0F : playing(hop); });
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[0].kind, MusicEvent::Kind::entry);
    EXPECT_EQ(told[0].at, 0);
    EXPECT_EQ(told[1].kind, MusicEvent::Kind::stop);
    EXPECT_EQ(told[1].at, 1'000);
    // The state of a hop comes 16 ms and the resampler's delay after its time.
    EXPECT_LE(told[1].told - told[1].at, 9);
    EXPECT_EQ(told[2].kind, MusicEvent::Kind::entry);
    EXPECT_EQ(told[2].at, 1'200);
    EXPECT_LE(told[2].told - told[2].at, 2);
}

TEST(PauseDetector, a_stop_with_hiss_30_db_under_the_band_is_known_within_300_ms) {
    // The band damps its strings within 60 ms; hiss goes on at -50 dBFS.
    const auto told = events_of(1'400, [](HopIndex hop) {
        const float damped = -20.0F - 5.0F * static_cast<float>(hop - 1'000);
        return hop >= 1'000 && hop < 1'200 ? std::max(damped, -50.0F) : playing(hop);
    });
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[1].kind, MusicEvent::Kind::stop);
    EXPECT_NEAR(static_cast<double>(told[1].at), 1'005.0, 2.0);
    EXPECT_LE(told[1].told - 1'000, 32);
    EXPECT_EQ(told[2].kind, MusicEvent::Kind::entry);
    EXPECT_EQ(told[2].at, 1'200);
}

TEST(PauseDetector, three_stops_in_a_row_are_three_stops) {
    // After 20 s half a second of silence and three quarters of sound in turn.
    const auto told = events_of(2'400, [](HopIndex hop) {
        const HopIndex since = hop - 2'000;
        return since >= 0 && since < 375 && since % 125 < 50 ? -80.0F : playing(hop);
    });
    int stops = 0;
    for (const Told& event : told) {
        stops += event.kind == MusicEvent::Kind::stop ? 1 : 0;
    }
    EXPECT_EQ(stops, 3);
}

TEST(PauseDetector, what_fades_away_is_a_stop_when_it_is_gone) {
    // From -20 dBFS by 1 dB a hop: 30 dB softer after 30 hops.
    const auto told = events_of(1'200, [](HopIndex hop) {
        return hop < 1'000 ? playing(hop) : -20.0F - static_cast<float>(hop - 1'000);
    });
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[1].kind, MusicEvent::Kind::stop);
    EXPECT_NEAR(static_cast<double>(told[1].at), 1'030.0, 6.0);
    EXPECT_LE(told[1].told - told[1].at, 45) << "when a beat is missed";
}

TEST(PauseDetector, gaps_between_the_notes_of_staccato_music_are_no_stops) {
    for (const HopIndex gap : {5, 12, 20, 35, 50}) {
        const auto told = events_of(
            6'000, [gap](HopIndex hop) { return hop % (gap + 15) < 15 ? -18.0F : -80.0F; });
        ASSERT_EQ(told.size(), 1U) << gap;
        EXPECT_EQ(told[0].kind, MusicEvent::Kind::entry);
    }
}

TEST(PauseDetector, staccato_music_that_stops_is_known_soon_after_its_longest_gap) {
    const auto told = events_of(
        2'200, [](HopIndex hop) { return hop < 2'000 && hop % 40 < 20 ? -18.0F : -80.0F; });
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[1].kind, MusicEvent::Kind::stop);
    EXPECT_EQ(told[1].at, 1'980);
    EXPECT_LE(told[1].told - told[1].at, 28);
}

TEST(PauseDetector, a_softer_part_is_no_stop) {
    const auto told = events_of(3'000, [](HopIndex hop) {
        return playing(hop) - (hop > 1'000 && hop < 2'000 ? 20.F : 0.F);
    });
    EXPECT_EQ(told.size(), 1U);
}

TEST(PauseDetector, three_seconds_without_sound_are_the_end) {
    const auto told =
        events_of(3'000, [](HopIndex hop) { return hop < 1'000 ? playing(hop) : -120.0F; });
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[2].kind, MusicEvent::Kind::end);
    EXPECT_EQ(told[2].at, 1'000);
    EXPECT_LE(told[2].told - told[2].at, 300);
}

TEST(PauseDetector, the_next_song_may_be_much_softer) {
    const auto told = events_of(3'000, [](HopIndex hop) {
        return hop < 1'000 ? playing(hop) : hop < 1'500 ? -120.0F : playing(hop) - 25.0F;
    });
    ASSERT_EQ(told.size(), 4U);
    EXPECT_EQ(told[3].kind, MusicEvent::Kind::entry);
    EXPECT_NEAR(static_cast<double>(told[3].at), 1'500.0, 3.0);
}

TEST(PauseDetector, the_noise_of_a_room_is_no_music) {
    // A microphone hears -50 dBFS of noise in the pause.
    const auto told = events_of(3'000, [](HopIndex hop) {
        return hop < 1'000 ? playing(hop) : -50.0F + 2.0F * std::sin(static_cast<float>(hop));
    });
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[1].kind, MusicEvent::Kind::stop);
    EXPECT_EQ(told[2].kind, MusicEvent::Kind::end);
}

TEST(PauseDetector, digital_silence_has_no_events) {
    EXPECT_TRUE(events_of(2'000, [](HopIndex) { return -120.0F; }).empty());
}

TEST(PauseDetector, the_level_of_the_input_does_not_matter) {
    const auto level = [](HopIndex hop) {
        return hop % 700 > 600 ? -100.0F : playing(hop) - (hop > 2'000 ? 10.0F : 0.0F);
    };
    const auto loud = events_of(4'000, level);
    const auto soft = events_of(4'000, [&](HopIndex hop) { return level(hop) - 20.0F; });
    ASSERT_EQ(loud.size(), soft.size());
    ASSERT_GT(loud.size(), 6U);
    for (std::size_t i = 0; i < loud.size(); ++i) {
        EXPECT_EQ(loud[i].kind, soft[i].kind);
        EXPECT_EQ(loud[i].at, soft[i].at);
        EXPECT_EQ(loud[i].told, soft[i].told);
    }
}

// Who knows that a pause comes need not wait whether it is a gap, however many the song has.
TEST(PauseDetector, an_announced_pause_is_known_after_20_ms_of_quiet_and_only_for_a_second) {
    for (const HopIndex announced : {990, 1'003, 850}) {
        PauseDetector detector;
        std::optional<HopIndex> stopped;
        for (HopIndex hop = 0; hop < 1'100; ++hop) {
            if (hop == announced) {
                detector.announce();
            }
            // Staccato: half of it is gaps of 80 ms.
            const bool is_gap = hop >= 1'000 || hop % 16 >= 8;
            const MusicEvent event = detector.advance(hop, is_gap ? -70.0F : playing(hop), 50);
            if (hop >= 1'000 && event.kind == MusicEvent::Kind::stop) {
                stopped = hop;
            }
            if (announced != 850) {
                EXPECT_EQ(event.kind == MusicEvent::Kind::stop && hop > 700 && hop < announced,
                          false);
            }
        }
        if (announced == 850) {
            EXPECT_FALSE(stopped && *stopped <= 1'005) << "it was told of another second";
        } else {
            ASSERT_TRUE(stopped);
            EXPECT_LE(*stopped, std::max<HopIndex>(announced, 1'000) + 2);
        }
    }
}

}  // namespace
}  // namespace raks::audio
