#include "engine/live/timing.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

TEST(TimingHistogram, quantiles_are_right_within_a_bin) {
    auto times = std::make_unique<TimingHistogram>();
    EXPECT_EQ(times->quantile_ms(0.5), 0.0);
    for (int i = 1; i <= 1000; ++i) {
        times->add(Nanos(i * 10'000));  // 0.01 to 10 ms
    }
    EXPECT_EQ(times->count(), 1000);
    EXPECT_NEAR(times->quantile_ms(0.5), 5.0, 5.0 * 0.03);
    EXPECT_NEAR(times->quantile_ms(0.99), 9.9, 9.9 * 0.03);
    EXPECT_DOUBLE_EQ(times->max_ms(), 10.0);
    EXPECT_DOUBLE_EQ(times->quantile_ms(1.0), 10.0);
}

TEST(TimingHistogram, takes_any_span_and_does_not_allocate) {
    auto times = std::make_unique<TimingHistogram>();
    test::RealtimeScope scope;
    times->add(Nanos(-5));
    times->add(Nanos(0));
    times->add(std::chrono::hours(10));
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(times->count(), 3);
}

}  // namespace
}  // namespace raks::engine
