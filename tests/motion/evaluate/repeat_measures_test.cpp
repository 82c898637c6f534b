#include "motion/evaluate/repeat_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/motion/evaluate/small_track.hpp"

namespace raks::motion {
namespace {

/// Hips go to and fro over 0.5 m once in 2 s, the left toe over 0.8 m, the right one rests.
BodyTrack rocking() {
    BodyTrack track = test::resting_track(240);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double swing = std::sin(M_PI * static_cast<double>(f) / 60.0);
        track.joints[f].fill({0.15 * swing, 1.0, 0.2 * swing});
        track.feet[f][0].toe_tip = {0.4 * swing, 0.0, 0.0};
    }
    return track;
}

TEST(Amplitude, is_the_widest_way_and_the_fastest_toe) {
    const Amplitude amplitude = amplitude_of(rocking(), 0, 120);
    EXPECT_NEAR(amplitude.hips_travel, 0.5, 1e-12);
    EXPECT_NEAR(amplitude.toe_travel, 0.8, 1e-12);
    EXPECT_NEAR(amplitude.peak_toe_speed, 0.4 * M_PI, 0.005) << "0.3 % is the filter's";
}

TEST(Amplitude, of_a_longer_foot_is_taken_where_a_shorter_one_ends) {
    BodyTrack track = test::resting_track(240);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const double turn = std::sin(M_PI * static_cast<double>(f) / 60.0);
        const glm::dvec3 ahead{std::sin(turn), 0.0, std::cos(turn)};
        track.feet[f][0] = {glm::dvec3(0.0), 0.22 * ahead};
        track.feet[f][1] = {glm::dvec3(0.0), 0.1 * ahead};
    }
    const Amplitude longer = amplitude_of(track, 0, 240);
    EXPECT_NEAR(longer.peak_toe_speed, 0.22 * M_PI, 0.01);
    EXPECT_NEAR(longer.peak_ball_speed, kBall * M_PI, 0.005);
    track.feet.assign(240, track.feet[0]);
    EXPECT_EQ(amplitude_of(track, 0, 240).peak_ball_speed, 0.0);
}

TEST(Amplitude, of_a_part_is_what_is_seen_there) {
    EXPECT_NEAR(amplitude_of(rocking(), 0, 31).hips_travel, 0.25, 1e-12);
    EXPECT_EQ(amplitude_of(rocking(), 5, 5).hips_travel, 0.0);
}

TEST(Amplitude, divides_speeds_by_the_pace_and_leaves_faults_out) {
    MetricFrames frames;
    frames.pace.assign(240, 2.0);
    EXPECT_NEAR(peak_toe_speed(rocking(), frames), 0.2 * M_PI, 0.0025);
    frames.pace.clear();
    BodyTrack faulty = rocking();
    faulty.feet[100][0].toe_tip.x += 3.0;
    EXPECT_GT(peak_toe_speed(faulty), 10.0);
    frames.counted.assign(240, true);
    for (std::size_t f = 96; f <= 104; ++f) {
        frames.counted[f] = false;
    }
    EXPECT_NEAR(peak_toe_speed(faulty, frames), 0.4 * M_PI, 0.005);
    EXPECT_NEAR(amplitude_of(faulty, 0, 240, frames).toe_travel, 0.8, 1e-12);
}

TEST(Jerk, leaves_out_what_is_not_counted_and_scales_with_the_pace) {
    BodyTrack track = rocking();
    const JerkReport whole = jerk_of(track);
    MetricFrames frames;
    frames.pace.assign(240, 2.0);
    EXPECT_NEAR(jerk_of(track, frames).rms, whole.rms / 8.0, 1e-9);
    frames.pace.clear();
    frames.counted.assign(240, true);
    const double highest = jerk_of(track, frames).highest;
    frames.counted[100] = false;
    for (auto& joint : track.joints[100]) {
        joint.y += 1.0;
    }
    EXPECT_GT(jerk_of(track).highest, 1e4);
    EXPECT_EQ(jerk_of(track, frames).highest, highest);
}

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
