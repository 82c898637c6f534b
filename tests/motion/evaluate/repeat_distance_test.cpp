#include "motion/evaluate/repeat_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/motion/evaluate/small_track.hpp"

namespace raks::motion {
namespace {

std::size_t index_of_joint(Bone bone) {
    std::size_t i = 0;
    while (kBodyBones[i] != bone) {
        ++i;
    }
    return i;
}

/// A body that walks `way` metres along its own front and turns by `turn` radians over 240 frames;
/// its left hand is `reach` before it.
BodyTrack walking(double way, double turn, double reach) {
    BodyTrack track = test::resting_track(241);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double share = static_cast<double>(f) / 240.0;
        const double heading = turn * share;
        const auto placed = [&](double left, double up, double forward) {
            return glm::dvec3(left * std::cos(heading) + forward * std::sin(heading) + way * share,
                              up,
                              forward * std::cos(heading) - left * std::sin(heading));
        };
        track.joints[f].fill(placed(0.0, 1.0, 0.0));
        track.joints[f][index_of_joint(Bone::left_upper_leg)] = placed(0.1, 0.9, 0.0);
        track.joints[f][index_of_joint(Bone::right_upper_leg)] = placed(-0.1, 0.9, 0.0);
        track.joints[f][index_of_joint(Bone::left_hand)] = placed(0.3, 1.2, reach);
    }
    return track;
}

const std::vector<double> kCounts = {0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0};

TEST(RepeatDistance, does_not_see_where_one_stands_and_where_one_faces) {
    const auto here = figure_shape(walking(0.0, 0.0, 0.2), kCounts);
    const auto there = figure_shape(walking(2.0, 0.3, 0.2), kCounts);
    ASSERT_TRUE(here && there);
    // Interpolation between frames cuts corners of the turn.
    EXPECT_NEAR(rms_distance(*here, *there), 0.0, 1e-6);
}

TEST(RepeatDistance, is_the_root_mean_square_over_17_joints) {
    const auto near = figure_shape(walking(0.0, 0.0, 0.2), kCounts);
    const auto far = figure_shape(walking(0.0, 0.0, 0.5), kCounts);
    ASSERT_TRUE(near && far);
    EXPECT_NEAR(rms_distance(*near, *far), 0.3 / std::sqrt(17.0), 1e-12);
    const std::vector<FigureShape> repeats = {*near, *far, *near};
    const auto distances = repeat_distances(repeats);
    ASSERT_EQ(distances.size(), 3U);
    EXPECT_EQ(distances[1], 0.0) << "the first and the third";
}

TEST(RepeatDistance, follows_the_counts_and_needs_them_inside_the_track) {
    const BodyTrack track = walking(0.0, 0.0, 0.2);
    EXPECT_TRUE(figure_shape(track, std::vector<double>{0.0, 1.5, 4.0}));
    EXPECT_FALSE(figure_shape(track, std::vector<double>{0.0, 2.0, 4.1}));
    EXPECT_FALSE(figure_shape(track, std::vector<double>{-0.1, 2.0}));
    EXPECT_FALSE(figure_shape(track, std::vector<double>{1.0}));
}

}  // namespace
}  // namespace raks::motion
