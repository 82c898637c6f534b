#include "motion/dance/dynamics/looks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/standing.hpp"
#include "tests/motion/dance/stage.hpp"

namespace raks::motion::looks_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }

double head_heading(const Pose& pose) {
    const glm::vec3 ahead =
        world_pose(body(), pose).rotation(Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F);
    return std::atan2(static_cast<double>(ahead.x), static_cast<double>(ahead.z));
}

/// The poses of a dancer who is about `what`, whose figures have it in these poses.
std::vector<Pose> looking(const std::vector<Pose>& figures, LookFor what, std::uint64_t seed = 7) {
    Looks looks;
    std::vector<Pose> poses;
    for (std::size_t hop = 0; hop < figures.size(); ++hop) {
        const Pose& before = hop > 0 ? poses.back() : figures.front();
        looks.advance(body(), time_of_hop(static_cast<HopIndex>(hop)), seed, what, before);
        Pose pose = figures[hop];
        looks.apply(body(), pose);
        poses.push_back(pose);
    }
    return poses;
}

std::vector<Pose> standing(double heading, std::size_t hops) {
    return std::vector<Pose>(hops, FloorMove{heading, {}}(idle_pose(body(), StreamTime{})));
}

TEST(Looks, who_poses_turns_the_head_to_the_audience) {
    for (const double heading : {-0.9, -0.4, 0.0, 0.5, 1.0}) {
        const Pose pose = looking(standing(heading, 100), LookFor::pose).back();
        EXPECT_LT(std::abs(head_heading(pose)), 0.35 * std::abs(heading) + 0.02) << heading;
    }
}

TEST(Looks, nobody_looks_at_the_feet_for_half_a_second) {
    std::vector<Pose> figures = standing(0.0, 400);
    for (std::size_t hop = 100; hop < figures.size(); ++hop) {
        const float down = 0.4F * std::min(1.0F, static_cast<float>(hop - 100) / 30.0F);
        for (const Bone bone : {Bone::neck, Bone::head}) {
            figures[hop].rotation(bone) = {std::cos(0.5F * down), std::sin(0.5F * down), 0, 0};
        }
    }
    int longest = 0;
    int hops = 0;
    for (const Pose& pose : looking(figures, LookFor::dance)) {
        const glm::vec3 ahead =
            world_pose(body(), pose).rotation(Bone::head) * glm::vec3(0.0F, 0.0F, 1.0F);
        hops = ahead.y < std::sin(-0.56F) ? hops + 1 : 0;  // 32 degrees
        longest = std::max(longest, hops);
    }
    EXPECT_GT(longest, 5) << "it would look down";
    EXPECT_LT(longest, 50);
}

TEST(Looks, nobody_looks_over_the_shoulder) {
    const std::vector<Pose> away = standing(M_PI - 0.2, 100);
    EXPECT_NEAR(head_heading(looking(away, LookFor::pose).back()), head_heading(away[0]), 1e-3);
}

TEST(Looks, who_waits_looks_around_and_never_throws_the_head) {
    const std::vector<Pose> poses = looking(standing(0.0, 6000), LookFor::wait);
    double left = 0.0;
    double right = 0.0;
    for (const Pose& pose : poses) {
        left = std::max(left, head_heading(pose));
        right = std::min(right, head_heading(pose));
    }
    EXPECT_GT(left, 0.2);
    EXPECT_LT(right, -0.2);
    EXPECT_LT(test::largest_step(poses, 0, 6000), 0.01) << "a meter a second";
}

TEST(Looks, a_spin_is_looked_out_of_smoothly) {
    std::vector<Pose> spin = standing(0.0, 100);
    for (int hop = 0; hop < 100; ++hop) {
        spin.push_back(standing(2.0 * M_PI * hop / 100.0, 1).front());
    }
    EXPECT_LT(test::largest_step(looking(spin, LookFor::pose), 0, 200), test::kFastestStep);
}

/// Greatest turn of the head to the left, of many looks.
double farthest_left(const std::vector<Pose>& figures) {
    double left = 0.0;
    for (const Pose& pose : looking(figures, LookFor::dance)) {
        left = std::max(left, head_heading(pose));
    }
    return left;
}

TEST(Looks, a_raised_hand_that_works_is_looked_at_and_one_that_rests_is_not) {
    const auto with_arm = [](double speed) {
        std::vector<Pose> poses = standing(0.0, 6000);
        for (std::size_t hop = 0; hop < poses.size(); ++hop) {
            // Straight out to the left, level as in the T-pose; its elbow bends and stretches.
            const double bend = 0.6 * std::sin(speed * 0.01 * static_cast<double>(hop));
            poses[hop].rotation(Bone::left_shoulder) = kNoRotation;
            poses[hop].rotation(Bone::left_upper_arm) = kNoRotation;
            poses[hop].rotation(Bone::left_lower_arm) =
                turn_about_up(static_cast<float>(-0.6 + bend));
        }
        return poses;
    };
    EXPECT_GT(farthest_left(with_arm(9.0)), 0.25);
    EXPECT_LT(farthest_left(with_arm(0.0)), 0.05);
}

TEST(Looks, who_travels_looks_along_the_way) {
    std::vector<Pose> walk = standing(0.0, 6000);
    for (std::size_t hop = 0; hop < walk.size(); ++hop) {
        walk[hop].hips_position.x = 0.006F * static_cast<float>(hop);
    }
    EXPECT_GT(farthest_left(walk), 0.3);
    EXPECT_LT(farthest_left(standing(0.0, 6000)), 0.05);
}

}  // namespace
}  // namespace raks::motion::looks_test
