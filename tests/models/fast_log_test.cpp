#include "models/fast_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks::models {
namespace {

TEST(FastLog, is_the_logarithm) {
    EXPECT_EQ(fast_log(1.0F), 0.0F);
    for (double x = 1e-37; x < 3e38; x *= 1.0009) {
        const auto given = static_cast<float>(x);
        const double expected = std::log(static_cast<double>(given));
        ASSERT_NEAR(fast_log(given), expected, 1e-7 + 2e-7 * std::abs(expected)) << given;
    }
}

}  // namespace
}  // namespace raks::models
