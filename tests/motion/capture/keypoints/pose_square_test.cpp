// Squares in pictures, turned so that who is in them stands upright.
#include "motion/capture/keypoints/pose_square.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

TEST(PoseSquare, stands_upright_about_the_hips) {
    // The head is above the hips in the picture: no turn.
    const PoseSquare upright = pose_square({100.0, 200.0}, {100.0, 120.0});
    EXPECT_DOUBLE_EQ(upright.side, 200.0);
    EXPECT_DOUBLE_EQ(upright.turn, 0.0);
    EXPECT_EQ(upright.to_picture({0.0, 0.0}), glm::dvec2(0.0, 100.0));
    EXPECT_EQ(upright.to_picture({1.0, 0.5}), glm::dvec2(200.0, 200.0));
    // Who lies with the head to the right: the square's top is at the right.
    const PoseSquare lying = pose_square({100.0, 200.0}, {180.0, 200.0});
    EXPECT_DOUBLE_EQ(lying.turn, std::numbers::pi / 2);
    const glm::dvec2 top = lying.to_picture({0.5, 0.0});
    EXPECT_NEAR(top.x, 200.0, 1e-9);
    EXPECT_NEAR(top.y, 200.0, 1e-9);
}

TEST(PoseSquare, there_and_back_is_the_same_place) {
    const PoseSquare square{{320.5, 240.25}, 300.0, 0.7};
    for (const glm::dvec2 place : {glm::dvec2(0.0, 0.0), {0.2, 0.9}, {1.5, -0.5}}) {
        EXPECT_NEAR(
            glm::distance(square.from_picture(square.to_picture(place)), place), 0.0, 1e-12);
    }
}

TEST(PoseSquare, overlap_is_a_share) {
    const PoseSquare square{{100.0, 100.0}, 100.0, 0.0};
    EXPECT_DOUBLE_EQ(overlap_of(square, square), 1.0);
    EXPECT_DOUBLE_EQ(overlap_of(square, {{150.0, 100.0}, 100.0, 0.0}), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(overlap_of(square, {{300.0, 100.0}, 100.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace raks::capture
