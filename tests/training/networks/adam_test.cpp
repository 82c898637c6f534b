#include "training/networks/adam.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace raks::audio {
namespace {

template <typename Number, typename Computed>
void expect_down_a_bowl(const AdamConstants& constants) {
    std::array<Number, 2> at = {3, -2};
    Adam<Number, Computed> adam(at.size(), constants);
    for (int i = 0; i < 400; ++i) {
        const std::array<Number, 2> gradient = {2 * at[0], 8 * at[1]};
        adam.step(gradient, 0.05, at);
    }
    EXPECT_NEAR(static_cast<double>(at[0]), 0.0, 0.05);
    EXPECT_NEAR(static_cast<double>(at[1]), 0.0, 0.05);
}

TEST(Adam, goes_down_a_bowl) {
    expect_down_a_bowl<float, double>({});
    expect_down_a_bowl<double, double>({.square_decay = 0.99, .epsilon = 1e-9});
    expect_down_a_bowl<float, float>(
        {.epsilon = 1e-7, .correction = AdamConstants::Correction::of_rate});
}

TEST(Adam, the_first_step_is_the_rate_against_the_gradients_sign) {
    for (const auto correction :
         {AdamConstants::Correction::of_means, AdamConstants::Correction::of_rate}) {
        std::array<double, 3> at{};
        Adam<double> adam(at.size(), {.correction = correction});
        adam.step(std::array{4.0, -0.5, 0.0}, 0.1, at);
        EXPECT_NEAR(at[0], -0.1, 1e-6);  // epsilon takes the rest
        EXPECT_NEAR(at[1], 0.1, 1e-6);
        EXPECT_EQ(at[2], 0.0);
    }
}

TEST(Adam, steps_are_those_of_the_equations) {
    std::array<double, 1> at = {1.0};
    Adam<double> adam(at.size());
    double expected = 1.0;
    double mean = 0.0;
    double square = 0.0;
    for (int step = 1; step <= 20; ++step) {
        const double slope = 0.5 * 2.0 * at[0];
        adam.step(std::array{2.0 * at[0]}, 0.01, at, 0.5);
        mean = 0.9 * mean + 0.1 * slope;
        square = 0.999 * square + 0.001 * slope * slope;
        expected -= 0.01 * (mean / (1.0 - std::pow(0.9, step))) /
                    (std::sqrt(square / (1.0 - std::pow(0.999, step))) + 1e-8);
        EXPECT_NEAR(at[0], expected, 1e-12) << step;  // rounding
    }
}

}  // namespace
}  // namespace raks::audio
