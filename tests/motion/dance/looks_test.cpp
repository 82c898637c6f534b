#include "motion/dance/dynamics/looks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

Pose looking(double heading, double seconds, LookFor what) {
    const StreamTime time = stream_time_from_seconds(seconds);
    Pose pose = FloorMove{heading, {}}(idle_pose(body(), StreamTime{}));
    look(body(), time, 7, {what, what}, pose);
    return pose;
}

TEST(Looks, who_poses_turns_the_head_to_the_audience) {
    for (const double heading : {-0.9, -0.4, 0.0, 0.5, 1.0}) {
        EXPECT_LT(std::abs(head_heading(looking(heading, 1.0, LookFor::pose))),
                  0.35 * std::abs(heading) + 0.02)
            << heading;
    }
}

TEST(Looks, nobody_looks_over_the_shoulder) {
    const Pose away = FloorMove{M_PI - 0.2, {}}(idle_pose(body(), StreamTime{}));
    EXPECT_NEAR(head_heading(looking(M_PI - 0.2, 1.0, LookFor::pose)), head_heading(away), 1e-3);
}

TEST(Looks, who_waits_looks_around_and_never_throws_the_head) {
    std::vector<Pose> poses;
    double left = 0.0;
    double right = 0.0;
    for (int hop = 0; hop < 6000; ++hop) {
        poses.push_back(looking(0.0, 0.01 * hop, LookFor::wait));
        left = std::max(left, head_heading(poses.back()));
        right = std::min(right, head_heading(poses.back()));
    }
    EXPECT_GT(left, 0.2);
    EXPECT_LT(right, -0.2);
    EXPECT_LT(test::largest_step(poses, 0, 6000), 0.01) << "a meter a second";
}

TEST(Looks, a_spin_is_looked_out_of_smoothly) {
    std::vector<Pose> poses;
    for (int hop = 0; hop < 100; ++hop) {
        poses.push_back(looking(2.0 * M_PI * hop / 100.0, 1.0 + 0.01 * hop, LookFor::pose));
    }
    EXPECT_LT(test::largest_step(poses, 0, 100), test::kFastestStep);
}

}  // namespace
}  // namespace raks::motion::looks_test
