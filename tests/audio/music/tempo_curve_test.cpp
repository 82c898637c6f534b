#include "audio/music/generator/tempo_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::audio {
namespace {

TEST(TempoCurve, steady_tempo_counts_beats_from_the_first) {
    const TempoCurve curve({{0.0, 120.0}}, 0.25);
    EXPECT_DOUBLE_EQ(curve.beats_at(0.25), 0.0);
    EXPECT_DOUBLE_EQ(curve.beats_at(10.25), 20.0);
    EXPECT_DOUBLE_EQ(curve.beats_at(0.0), -0.5);
    EXPECT_DOUBLE_EQ(curve.seconds_at(7.0), 3.75);
}

TEST(TempoCurve, a_ramp_is_integrated_exactly) {
    // 60 to 120 BPM over 10 s: (1 + 2)/2 beats a second, 15 beats; then 2 a second.
    const TempoCurve curve({{0.0, 60.0}, {10.0, 120.0}}, 0.0);
    EXPECT_DOUBLE_EQ(curve.bpm_at(5.0), 90.0);
    EXPECT_NEAR(curve.beats_at(10.0), 15.0, 1e-12);
    EXPECT_NEAR(curve.beats_at(5.0), 5.0 + 0.5 * 0.1 * 25.0, 1e-12);
    EXPECT_NEAR(curve.seconds_at(15.0), 10.0, 1e-12);
    EXPECT_NEAR(curve.seconds_at(17.0), 11.0, 1e-12);
    // t + 0.05 t^2 = 1
    EXPECT_NEAR(curve.seconds_at(1.0), -10.0 + std::sqrt(120.0), 1e-12);
}

TEST(TempoCurve, two_points_at_one_second_are_a_jump) {
    const TempoCurve curve({{0.0, 90.0}, {20.0, 90.0}, {20.0, 140.0}}, 0.0);
    EXPECT_DOUBLE_EQ(curve.bpm_at(19.999), 90.0);
    EXPECT_DOUBLE_EQ(curve.bpm_at(20.0), 140.0);
    EXPECT_NEAR(curve.beats_at(20.0), 30.0, 1e-12);
    EXPECT_NEAR(curve.seconds_at(37.0), 23.0, 1e-12);
}

TEST(TempoCurve, seconds_at_and_beats_at_are_inverses) {
    const TempoCurve curve({{1.0, 100.0}, {8.0, 160.0}, {8.0, 75.0}, {20.0, 60.0}, {31.0, 200.0}},
                           0.4);
    for (double beats = -3.0; beats < 120.0; beats += 0.37) {
        EXPECT_NEAR(curve.beats_at(curve.seconds_at(beats)), beats, 1e-9);
    }
}

}  // namespace
}  // namespace raks::audio
