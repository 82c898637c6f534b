// Distances of points against sums that are made by hand, and against numpy's.
#include "motion/evaluate/point_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "motion/evaluate/point_alignment.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

// Points whose places the reference below writes down in the same way:
//   import numpy as np
//   i = np.arange(40)[:, None, None]; p = np.arange(5)[None, :, None]; a = np.arange(3)
//   one = np.sin(0.1 * i + 0.7 * p + 1.3 * a)
//   other = one + 0.01 * np.cos(0.37 * i + p * p + 2.0 * a)
WorldPoints waves(double difference) {
    WorldPoints points;
    points.named = 5;
    points.clip.frame_count = 40;
    points.clip.frames_per_second = 50.0;
    for (int p = 0; p < 5; ++p) {
        points.clip.names.push_back("p" + std::to_string(p));
    }
    for (int i = 0; i < 40; ++i) {
        for (int p = 0; p < 5; ++p) {
            glm::dvec3 place(0.0);
            for (int a = 0; a < 3; ++a) {
                place[a] = std::sin(0.1 * i + 0.7 * p + 1.3 * a) +
                           difference * std::cos(0.37 * i + p * p + 2.0 * a);
            }
            points.clip.positions.push_back(place);
        }
    }
    return points;
}

PointComparison compared(const WorldPoints& one, const WorldPoints& other) {
    const auto comparison = compare_points(one, other, common_points(one, other));
    EXPECT_TRUE(comparison) << comparison.error().message;
    return comparison.value_or(PointComparison{});
}

//   d = np.linalg.norm(one - other, axis=2)
//   np.sqrt((d**2).mean()); np.sqrt((d**2).mean(axis=0)); np.sqrt((d**2).mean(axis=1)).argmax()
TEST(PointComparison, is_numpys) {
    const PointComparison comparison = compared(waves(0.0), waves(0.01));
    EXPECT_NEAR(comparison.rms, 0.012230637504, 1e-9);
    const std::vector<double> by_point = {
        0.012216191463, 0.012247778484, 0.012238211342, 0.012237288044, 0.012213681738};
    ASSERT_EQ(comparison.points.size(), by_point.size());
    for (std::size_t i = 0; i < by_point.size(); ++i) {
        EXPECT_NEAR(comparison.points[i].rms, by_point[i], 1e-9) << i;
    }
    EXPECT_EQ(comparison.worst_frame, 15U);
    EXPECT_NEAR(comparison.worst_frame_rms, 0.012564136454, 1e-9);
    EXPECT_EQ(comparison.worst_point, 1U);
    EXPECT_EQ(comparison.points[0].worst_frame, 16U);
}

//   numpy's SVD of the centred places (Kabsch), then the same RMS
TEST(PointAlignment, rigid_leaves_what_kabsch_leaves) {
    const WorldPoints one = waves(0.0);
    WorldPoints other = waves(0.01);
    const glm::dquat turn = glm::angleAxis(2.2, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
    for (glm::dvec3& place : other.clip.positions) {
        place = turn * place + glm::dvec3(5.0, -1.0, 3.0);
    }
    ASSERT_TRUE(align(one, other, common_points(one, other), PointAlignment::rigid));
    EXPECT_NEAR(compared(one, other).rms, 0.012173821531, 1e-9);
}

TEST(PointAlignment, by_hips_lays_them_over_each_other_in_each_frame) {
    WorldPoints one = waves(0.0);
    one.clip.names[2] = "hips";
    WorldPoints other = one;
    for (std::size_t frame = 0; frame < 40; ++frame) {
        const glm::dquat turn = glm::angleAxis(0.8, glm::dvec3(0.0, 1.0, 0.0));
        for (std::size_t point = 0; point < 5; ++point) {
            glm::dvec3& place = other.clip.positions[frame * 5 + point];
            place = turn * place + glm::dvec3(0.02 * static_cast<double>(frame), 0.0, 1.0);
        }
    }
    const auto pairs = common_points(one, other);
    WorldPoints by_hips = other;
    ASSERT_TRUE(align(one, by_hips, pairs, PointAlignment::hips));
    const PointComparison turned = compared(one, by_hips);
    EXPECT_NEAR(turned.points[2].rms, 0.0, 1e-12);
    EXPECT_GT(turned.rms, 0.1);
    WorldPoints both = other;
    ASSERT_TRUE(align(one, both, pairs, PointAlignment::both));
    EXPECT_NEAR(compared(one, both).rms, 0.0, 1e-9);
    other.clip.names[2] = "p2";
    EXPECT_EQ(align(one, other, pairs, PointAlignment::hips).error().message,
              "the second motion has no hips to align by; --align rigid needs none");
}

TEST(PointComparison, leaves_out_what_either_did_not_see) {
    const WorldPoints one = waves(0.0);
    WorldPoints other = waves(0.0);
    const glm::dvec3 unseen(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t frame = 0; frame < 40; ++frame) {
        other.clip.positions[frame * 5 + 1] = unseen;
        other.clip.positions[frame * 5 + 2] += glm::dvec3(0.0, frame == 17 ? 0.5 : 0.1, 0.0);
    }
    other.clip.positions[17 * 5] = unseen;
    const PointComparison comparison = compared(one, other);
    EXPECT_EQ(comparison.points[0].frames, 39U);
    EXPECT_EQ(comparison.points[1].frames, 0U);
    EXPECT_EQ(comparison.points[2].worst_frame, 17U);
    EXPECT_NEAR(comparison.points[2].worst, 0.5, 1e-12);
    EXPECT_NEAR(comparison.points[2].rms, std::sqrt((39 * 0.01 + 0.25) / 40.0), 1e-12);
    EXPECT_EQ(comparison.worst_point, 2U);
    EXPECT_EQ(comparison.worst_frame, 17U);
    // Three points are seen in that frame.
    EXPECT_NEAR(comparison.worst_frame_rms, std::sqrt(0.25 / 3.0), 1e-12);
    EXPECT_TRUE(std::isnan(comparison.points[0].over_time[17]));
}

TEST(PointComparison, brings_other_rates_and_beginnings_to_the_same_moments) {
    const auto line = [](double rate, std::size_t frames, double from) {
        WorldPoints points;
        points.named = 1;
        points.clip.names = {"p"};
        points.clip.frames_per_second = rate;
        points.clip.frame_count = frames;
        for (std::size_t i = 0; i < frames; ++i) {
            points.clip.positions.emplace_back(from + static_cast<double>(i) / rate, 0.0, 0.0);
        }
        return points;
    };
    const WorldPoints one = line(50.0, 101, 0.0);
    const WorldPoints other = at_frames_of(one, line(30.0, 31, 0.5), 0.5);
    const PointComparison comparison = compared(one, other);
    EXPECT_EQ(comparison.frames, 51U) << "from 0.5 s to 1.5 s, both ends";
    EXPECT_NEAR(comparison.rms, 0.0, 1e-12);
    const WorldPoints never = at_frames_of(one, line(30.0, 31, 0.0), 9.0);
    EXPECT_EQ(compare_points(one, never, common_points(one, never)).error().message,
              "the two motions have no moment in common in which both see a point; is --shift "
              "right?");
}

TEST(PointComparison, pairs_points_by_name_then_loosely_then_by_bone) {
    WorldPoints one;
    one.clip.names = {"ns:Hips", "Arm", "twice", "left", "tip"};
    one.named = 4;
    one.bones = {Bone::hips, Bone::left_upper_arm, std::nullopt, Bone::left_hand};
    WorldPoints other;
    other.clip.names = {"wrist", "twice", "Twice", "hips", "Arm"};
    other.named = 5;
    other.bones = {Bone::left_hand, std::nullopt, std::nullopt, std::nullopt, Bone::head};
    const auto pairs = common_points(one, other);
    ASSERT_EQ(pairs.size(), 4U);
    EXPECT_EQ(pairs[0].other, 3U) << "without prefix and case";
    EXPECT_EQ(pairs[1].other, 4U) << "the name counts more than the bone";
    EXPECT_EQ(pairs[2].other, 1U);
    EXPECT_EQ(pairs[3].other, 0U) << "by bone";
    other.clip.names = {"a", "b", "c", "d", "e"};
    other.bones.clear();
    EXPECT_EQ(compare_points(one, other, common_points(one, other)).error().message,
              "the two motions have no point of the same name");
}

}  // namespace
}  // namespace raks::motion
