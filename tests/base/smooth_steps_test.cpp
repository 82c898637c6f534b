#include "base/smooth_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace raks {
namespace {

TEST(SmoothSteps, lead_from_0_to_1_with_flat_ends) {
    for (const auto step : {+[](float t) { return smoothstep(2.0F, 4.0F, 2.0F + 2.0F * t); },
                            +[](float t) { return smootherstep(2.0F, 4.0F, 2.0F + 2.0F * t); },
                            +[](float t) { return smootherstep(t); }}) {
        EXPECT_EQ(step(-1.0F), 0.0F);
        EXPECT_EQ(step(0.0F), 0.0F);
        EXPECT_EQ(step(0.5F), 0.5F);
        EXPECT_EQ(step(1.0F), 1.0F);
        EXPECT_EQ(step(2.0F), 1.0F);
        EXPECT_LT(step(0.01F), 0.0004F);
        EXPECT_GT(step(0.99F), 0.9996F);
        for (float t = 0.0F; t < 1.0F; t += 1.0F / 64) {
            EXPECT_LT(step(t), step(t + 1.0F / 64)) << t;
        }
    }
}

TEST(SmoothSteps, fall_where_the_ends_are_crossed) {
    EXPECT_EQ(smoothstep(4.0F, 2.0F, 2.0F), 1.0F);
    EXPECT_EQ(smootherstep(4.0F, 2.0F, 4.0F), 0.0F);
}

TEST(SmoothSteps, the_smoother_one_starts_without_acceleration) {
    const float t = 1e-3F;
    EXPECT_NEAR(smoothstep(0.0F, 1.0F, t) / (t * t), 3.0F, 0.01F);
    EXPECT_NEAR(smootherstep(t) / (t * t), 0.0F, 0.02F);
}

}  // namespace
}  // namespace raks
