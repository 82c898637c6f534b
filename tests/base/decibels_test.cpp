#include "base/decibels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace raks {
namespace {

TEST(Decibels, of_known_signals) {
    const std::vector<float> square = {0.5F, -0.5F, 0.5F, -0.5F};
    EXPECT_EQ(mean_square(square), 0.25);
    EXPECT_EQ(mean_square(square, 1.0), 0.5) << "1 more of energy over four samples";
    EXPECT_EQ(mean_square({}), 0.0);
    EXPECT_NEAR(decibels_of_power(mean_square(square)), -6.0206, 1e-4);
}

TEST(Decibels, amplitude_and_power_are_inverse) {
    for (const double decibels : {-60.0, -3.0, 0.0, 6.0}) {
        const double amplitude = amplitude_of_decibels(decibels);
        EXPECT_NEAR(decibels_of_power(amplitude * amplitude), decibels, 1e-12);
    }
    EXPECT_EQ(amplitude_of_decibels(20.0), 10.0);
}

}  // namespace
}  // namespace raks
