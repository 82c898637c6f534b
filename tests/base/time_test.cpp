#include "base/time.hpp"

#include <gtest/gtest.h>

#include "base/beats.hpp"

namespace raks {
namespace {

template <typename T>
concept Addable = requires(T a, T b) {
    a + b;
};
static_assert(!Addable<StreamTime>, "two positions must not add");
static_assert(Addable<Nanos>);

TEST(Time, hops_are_exactly_10_ms) {
    EXPECT_EQ(time_of_hop(0), StreamTime{});
    EXPECT_EQ(time_of_hop(123'456'789).time_since_epoch().count(), 1'234'567'890'000'000);
}

TEST(Time, sample_times_do_not_drift_over_ten_hours) {
    for (const int hertz : {8'000, 11'025, 22'050, 44'100, 48'000, 96'000, 192'000}) {
        const SampleRate rate(hertz);
        const std::int64_t last = std::int64_t{36'000} * hertz;
        EXPECT_EQ(rate.time_of(last), stream_time_from_seconds(36'000)) << hertz;
    }
}

TEST(Time, index_at_is_the_inverse_of_time_of) {
    for (const int hertz : {8'000, 44'100, 192'000}) {
        const SampleRate rate(hertz);
        for (std::int64_t i = 0; i < 5'000'000; i += 977) {
            ASSERT_EQ(rate.index_at(rate.time_of(i) + Nanos(1)), i + 1) << hertz;
            ASSERT_LE(rate.time_of(i), rate.time_of(i + 1));
        }
    }
}

TEST(Time, rates_from_8_to_192_khz_are_supported) {
    EXPECT_FALSE(SampleRate(7'999).is_supported());
    EXPECT_TRUE(SampleRate(8'000).is_supported());
    EXPECT_TRUE(SampleRate(192'000).is_supported());
    EXPECT_FALSE(SampleRate(0).is_supported());
}

TEST(Beats, phase_of_a_negative_position_wraps) {
    EXPECT_DOUBLE_EQ(BeatPhase(Beats(-0.25)).value(), 0.75);
    EXPECT_DOUBLE_EQ(BeatPhase(Beats(3.0)).value(), 0.0);
    EXPECT_LT(BeatPhase(Beats(-1e-18)).value(), 1.0);
}

}  // namespace
}  // namespace raks
