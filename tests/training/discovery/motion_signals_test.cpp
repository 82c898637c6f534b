#include "training/discovery/motion_signals.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::motion_signals_test {
namespace {

TEST(MotionSignals, are_nearly_the_same_at_every_rate) {
    test::SteppingDance dance;
    const MotionSignals at_60 = motion_signals(test::stepping_clip(dance));
    EXPECT_NEAR(at_60.seconds(), 2.0 + 6 * 8 * 0.36, 0.1);
    for (const double rate : {24.0, 29.97, 119.88, 120.0, 240.0}) {
        dance.frames_per_second = rate;
        const MotionSignals other = motion_signals(test::stepping_clip(dance));
        ASSERT_NEAR(
            static_cast<double>(other.track.rows()), static_cast<double>(at_60.track.rows()), 2.0);
        double square = 0.0;
        double all = 0.0;
        for (std::size_t i = 0; i < std::min(at_60.track.rows(), other.track.rows()); ++i) {
            for (std::size_t c = 0; c < at_60.track.columns; ++c) {
                const double d = at_60.track.row(i)[c] - other.track.row(i)[c];
                square += d * d;
                all += at_60.track.row(i)[c] * at_60.track.row(i)[c];
            }
        }
        EXPECT_LT(square, 0.02 * all) << rate;
    }
}

TEST(MotionSignals, land_where_the_feet_do) {
    const test::SteppingDance dance;
    const MotionSignals signals = motion_signals(test::stepping_clip(dance));
    // Counts 1, 2, 3, 5, 6, 7 of every repeat; the small step on 6 may be too slow to be one.
    ASSERT_GE(signals.landings.size(), 30U);
    const SignalLanding& first = signals.landings.front();
    EXPECT_EQ(first.side, Side::left);
    EXPECT_NEAR(first.row / kSignalRate, dance.count_1(0), 0.12);
}

TEST(MotionSignals, a_fast_sine_of_the_feet_is_not_heard_as_a_slow_one) {
    // 29 Hz sampled at 120 would appear as 1 Hz at 30 rows a second.
    TrainingClip clip;
    clip.frames_per_second = 120.0;
    for (int f = 0; f < 1200; ++f) {
        // It grows and fades, so that the ends of the clip play no part.
        const double size = 0.01 * std::pow(std::sin(M_PI * f / 1200.0), 2.0);
        const double z = size * std::sin(2.0 * M_PI * 29.0 * f / 120.0);
        Pose pose;
        pose.hips_position = {0.0F, 0.9F, 0.0F};
        clip.poses.push_back(pose);
        clip.feet.push_back({SourceFoot{{0.1, 0.08, z}, {0.1, 0.02, z}},
                             SourceFoot{{-0.1, 0.08, 0.0}, {-0.1, 0.02, 0.0}}});
    }
    // Its speed is 1.8 m/s.
    EXPECT_LT(motion_signals(clip).movement, 0.02);
}

}  // namespace
}  // namespace raks::motion::motion_signals_test
