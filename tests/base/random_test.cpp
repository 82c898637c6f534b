#include "base/random.hpp"

#include <gtest/gtest.h>

namespace raks {
namespace {

TEST(CounterRandom, the_same_counter_gives_the_same_number_in_any_order) {
    const CounterRandom a(7, 3);
    const CounterRandom b(7, 3);
    EXPECT_EQ(a.bits(1'000'000), b.bits(1'000'000));
    EXPECT_EQ(a.bits(0), b.bits(0));
    EXPECT_NE(CounterRandom(7, 4).bits(0), a.bits(0));
    EXPECT_NE(CounterRandom(8, 3).bits(0), a.bits(0));
}

TEST(CounterRandom, uniform_and_normal_have_their_moments) {
    const CounterRandom random(1);
    constexpr int kCount = 100'000;
    double uniform_sum = 0, normal_sum = 0, normal_square = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const double u = random.uniform(i);
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        uniform_sum += u;
        const double n = random.normal(i);
        normal_sum += n;
        normal_square += n * n;
    }
    // 5 standard errors of each mean.
    EXPECT_NEAR(uniform_sum / kCount, 0.5, 5 * 0.289 / 316);
    EXPECT_NEAR(normal_sum / kCount, 0.0, 5.0 / 316);
    EXPECT_NEAR(normal_square / kCount, 1.0, 5 * 1.414 / 316);
}

}  // namespace
}  // namespace raks
