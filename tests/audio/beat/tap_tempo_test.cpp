#include "audio/beat/tap_tempo.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace raks::audio
