// Skeletons whose joints are known, as points that are joined by nothing.
#include "motion/skeleton/points/guessed_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/dice.hpp"
#include "motion/skeleton/points/joint_points.hpp"

namespace raks::motion {
namespace {

// A body of rigid bones that all turn by themselves: a trunk of two, two arms and two legs of
// three; in metres.
MotionClip moving_body() {
    MotionClip clip;
    clip.frame_count = 300;
    clip.frames_per_second = 100.0;
    const auto add = [&](std::size_t parent, const glm::dvec3& offset) {
        clip.joints.push_back({"j" + std::to_string(clip.joints.size()), parent, offset, {}});
        return clip.joints.size() - 1;
    };
    const std::size_t hips = add(0, {0.0, 0.95, 0.0});
    const std::size_t chest = add(hips, {0.0, 0.35, 0.0});
    add(chest, {0.0, 0.25, 0.0});
    for (const double side : {-1.0, 1.0}) {
        std::size_t arm = add(chest, {0.22 * side, 0.1, 0.0});
        arm = add(arm, {0.28 * side, 0.0, 0.0});
        add(arm, {0.25 * side, 0.0, 0.0});
        std::size_t leg = add(hips, {0.12 * side, -0.05, 0.0});
        leg = add(leg, {0.0, -0.42, 0.0});
        add(leg, {0.0, -0.42, 0.0});
    }
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (std::size_t j = 0; j < clip.joints.size(); ++j) {
            const double turn = 0.9 * std::sin(0.02 * static_cast<double>((j + 2) * frame) +
                                               static_cast<double>(j));
            const glm::dvec3 axis(j % 3 == 0 ? 1.0 : 0.3, j % 3 == 1 ? 1.0 : 0.2, 0.5);
            clip.rotations.push_back(glm::angleAxis(turn, glm::normalize(axis)));
            clip.positions.push_back(clip.joints[j].offset);
        }
    }
    return clip;
}

std::vector<PointEdge> sorted(std::vector<PointEdge> edges) {
    std::sort(edges.begin(), edges.end());
    return edges;
}

TEST(GuessedEdges, of_a_body_that_moves_are_its_bones) {
    const WorldPoints points = joint_points(moving_body());
    EXPECT_EQ(guess_edges(points.clip), sorted(points.edges));
}

TEST(GuessedEdges, stay_the_same_with_noise_gaps_and_leaps) {
    WorldPoints points = joint_points(moving_body());
    Dice dice(7, 0);
    for (glm::dvec3& place : points.clip.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] += 0.002 * (2.0 * dice.uniform() - 1.0);
        }
        if (dice.uniform() < 0.3) {
            place = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
        } else if (dice.uniform() < 0.01) {
            place += glm::dvec3(3.0, 0.0, 0.0);
        }
    }
    EXPECT_EQ(guess_edges(points.clip), sorted(points.edges));
}

TEST(GuessedEdges, leave_apart_what_moves_apart) {
    PointClip clip;
    clip.names = {"a", "b", "c", "d", "never"};
    clip.frame_count = 100;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double far = 0.03 * static_cast<double>(frame);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        clip.positions.insert(
            clip.positions.end(),
            {{0.0, 0.0, 0.0}, {0.0, 0.3, 0.0}, {far, 0.0, 1.0}, {far, 0.3, 1.0}, {nan, nan, nan}});
    }
    EXPECT_EQ(guess_edges(clip), (std::vector<PointEdge>{{0, 1}, {2, 3}}));
}

TEST(GuessedEdges, of_what_stands_still_join_neighbours) {
    PointClip clip;
    clip.names = {"a", "c", "b"};
    clip.frame_count = 1;
    clip.positions = {{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}};
    EXPECT_EQ(guess_edges(clip), (std::vector<PointEdge>{{0, 2}, {1, 2}}));
    EXPECT_TRUE(guess_edges(PointClip{}).empty());
    clip.names = {"a"};
    clip.positions.resize(1);
    EXPECT_TRUE(guess_edges(clip).empty());
}

}  // namespace
}  // namespace raks::motion
