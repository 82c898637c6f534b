#include "audio/beat/tap_tempo.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace raks::audio {
namespace {

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

TEST(TapTempo, says_nothing_before_the_third_tap) {
    TapTempo taps;
    EXPECT_FALSE(taps.tap(at(0.0)));
    EXPECT_FALSE(taps.tap(at(0.5)));
    EXPECT_NEAR(taps.tap(at(1.0)).value(), 120.0, 1e-6);
}

TEST(TapTempo, one_bad_tap_does_not_move_the_median) {
    TapTempo taps;
    std::optional<double> bpm;
    for (const double time : {0.0, 0.5, 1.0, 1.62, 2.0, 2.5, 3.0}) {
        bpm = taps.tap(at(time));
    }
    EXPECT_NEAR(bpm.value(), 120.0, 1e-6);
}

TEST(TapTempo, a_pause_starts_a_new_row_and_a_bounce_is_ignored) {
    TapTempo taps;
    for (const double time : {0.0, 0.5, 1.0}) {
        taps.tap(at(time));
    }
    EXPECT_FALSE(taps.tap(at(9.0)));
    EXPECT_FALSE(taps.tap(at(9.02)));
    EXPECT_FALSE(taps.tap(at(9.4)));
    EXPECT_NEAR(taps.tap(at(9.8)).value(), 150.0, 1e-6);
}

// As those of a network that takes 20 to 40 ms.
TEST(TapTempo, taps_whose_delay_trembles_by_10_ms_give_the_tempo_to_half_a_percent) {
    for (const double bpm : {60.0, 90.0, 111.3, 140.0, 180.0}) {
        for (unsigned seed = 1; seed <= 50; ++seed) {
            std::minstd_rand numbers(seed);
            std::uniform_real_distribution<double> delay(0.02, 0.04);
            TapTempo taps;
            std::optional<double> tapped;
            for (int i = 0; i < 20; ++i) {
                tapped = taps.tap(at(i * 60.0 / bpm + delay(numbers)));
            }
            EXPECT_NEAR(tapped.value() / bpm, 1.0, 0.005) << bpm << " BPM, seed " << seed;
        }
    }
}

TEST(TapTempo, a_tap_that_is_left_out_does_not_slow_it) {
    TapTempo taps;
    std::optional<double> bpm;
    for (const double time : {0.0, 0.5, 1.0, 2.0, 2.5, 3.0}) {
        bpm = taps.tap(at(time));
    }
    EXPECT_NEAR(bpm.value(), 120.0, 1e-6);
}

TEST(TapTempo, another_tempo_is_followed_after_four_taps) {
    for (const double interval : {0.4, 0.6}) {
        TapTempo taps;
        double time = 0.0;
        for (int i = 0; i < 12; ++i) {
            taps.tap(at(time += 0.5));
        }
        std::optional<double> bpm;
        for (int i = 0; i < 4; ++i) {
            bpm = taps.tap(at(time += interval));
        }
        EXPECT_NEAR(bpm.value(), 60.0 / interval, 0.03 * 60.0 / interval);
    }
}

}  // namespace
}  // namespace raks::audio
