#include "motion/capture/angles/annealing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/dice.hpp"

namespace raks::capture {
namespace {

std::vector<float> drawn_costs(std::size_t count) {
    Dice dice(3, 1);
    std::vector<float> costs(count);
    for (float& cost : costs) {
        cost = static_cast<float>(dice.uniform(10.0, 60.0));
    }
    return costs;
}

TEST(Annealing, lets_as_many_survive_as_wanted) {
    const std::vector<float> costs = drawn_costs(300);
    std::vector<float> weights(costs.size());
    for (const double survival : {0.05, 0.25, 0.75}) {
        anneal(costs, survival, weights);
        EXPECT_NEAR(survival_of(weights), survival, 0.02 * survival);
        // The better a particle, the more it weighs.
        const auto best = std::min_element(costs.begin(), costs.end()) - costs.begin();
        EXPECT_EQ(weights[static_cast<std::size_t>(best)], 1.0F);
        EXPECT_EQ(*std::max_element(weights.begin(), weights.end()), 1.0F);
    }
}

TEST(Annealing, particles_that_are_equally_good_weigh_the_same) {
    const std::vector<float> costs(64, 7.0F);
    std::vector<float> weights(costs.size());
    anneal(costs, 0.25, weights);
    EXPECT_EQ(weights, std::vector<float>(costs.size(), 1.0F));
}

TEST(Annealing, resampling_takes_each_as_often_as_it_weighs_give_or_take_one) {
    const std::vector<float> weights = {0.0F, 3.0F, 0.5F, 0.5F, 0.0F, 1.0F, 1.0F, 2.0F};
    std::vector<std::size_t> chosen;
    for (const double start : {0.0, 0.3, 0.999}) {
        resample(weights, start, chosen);
        ASSERT_EQ(chosen.size(), weights.size());
        EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto count = static_cast<double>(std::count(chosen.begin(), chosen.end(), i));
            EXPECT_NEAR(count, static_cast<double>(weights[i]), 0.999) << i;
        }
    }
}

}  // namespace
}  // namespace raks::capture
