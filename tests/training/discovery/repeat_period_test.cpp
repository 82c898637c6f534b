#include "training/discovery/repeat_period.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "tests/training/discovery/stepping_dance.hpp"
#include "training/discovery/motion_signals.hpp"

namespace raks::motion::repeat_period_test {
namespace {

FeatureTrack noise(std::size_t rows) {
    FeatureTrack track;
    track.columns = 3;
    const CounterRandom random(7);
    for (std::size_t i = 0; i < 3 * rows; ++i) {
        track.values.push_back(random.uniform(i) - 0.5);
    }
    return track;
}

TEST(RepeatPeriod, is_that_of_the_figure_at_every_tempo) {
    for (const double beat : {0.3, 0.36, 0.5}) {
        test::SteppingDance dance;
        dance.beat = beat;
        dance.repeats = 8;
        const MotionSignals signals = motion_signals(test::stepping_clip(dance));
        const auto period = best_period(signals.track);
        ASSERT_TRUE(period);
        EXPECT_NEAR(period->rows / kSignalRate, 8.0 * beat, 0.02 * 8.0 * beat) << beat;
        EXPECT_GT(period->explained, 0.4) << beat;
    }
}

TEST(RepeatPeriod, of_noise_explains_nothing) {
    const FeatureTrack track = noise(900);
    for (const double rows : {30.0, 75.0, 200.0}) {
        EXPECT_LT(explained_by_period(track, rows), 0.03) << rows;
    }
}

TEST(RepeatPeriod, keeps_to_what_is_allowed) {
    const MotionSignals signals = motion_signals(test::stepping_clip({}));
    PeriodSearch search;
    search.is_allowed = [](double seconds) { return seconds < 2.0; };
    const auto period = best_period(signals.track, search);
    ASSERT_TRUE(period);
    EXPECT_LT(period->rows / kSignalRate, 2.0);
}

TEST(RepeatPeriod, needs_two_and_a_half_of_them) { EXPECT_FALSE(best_period(noise(40))); }

}  // namespace
}  // namespace raks::motion::repeat_period_test
