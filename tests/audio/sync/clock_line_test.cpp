#include "audio/sync/clock_line.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/dice.hpp"

namespace raks::audio {
namespace {

TEST(ClockLine, its_inverse_leads_back_and_chains_add_up) {
    const ClockLine a{1.5, 300.0};
    const ClockLine b{-20.0, -450.0};
    for (const double t : {-3.0, 0.0, 1'000.0}) {
        EXPECT_NEAR(a.inverse().at(a.at(t)), t, 1e-10);
        EXPECT_NEAR(a.then(b).at(t), b.at(a.at(t)), 1e-10);
    }
}

TEST(ClockLine, points_off_the_line_do_not_bend_it) {
    Dice dice(1, 1);
    const ClockLine truth{0.7, -42.0};
    for (int round = 0; round < 20; ++round) {
        std::vector<ClockPoint> points;
        for (int i = 0; i < 20; ++i) {
            const double time = 2.5 * i;
            const double error = i % 5 < 2 ? dice.uniform(0.01, 0.1) * (dice.chance(0.5) ? 1 : -1)
                                           : dice.normal(2e-5);
            points.push_back({time, truth.at(time) + error, 1.0, 10.0});
        }
        const auto fit = fit_clock_line(points, 0.001);
        ASSERT_TRUE(fit);
        EXPECT_EQ(fit->used, 12U);
        EXPECT_NEAR(fit->line.offset, truth.offset, 1e-4);
        EXPECT_NEAR(fit->line.drift_ppm, truth.drift_ppm, 2.0);
        EXPECT_LT(fit->spread, 1e-4);
    }
}

TEST(ClockLine, no_line_through_one_moment) {
    EXPECT_FALSE(fit_clock_line({}, 0.001));
    const std::vector<ClockPoint> one{{1.0, 2.0, 1.0, 1.0}};
    EXPECT_FALSE(fit_clock_line(one, 0.001));
    const std::vector<ClockPoint> same{{1.0, 2.0, 1.0, 1.0}, {1.0, 2.1, 1.0, 1.0}};
    EXPECT_FALSE(fit_clock_line(same, 0.001));
}

}  // namespace
}  // namespace raks::audio
