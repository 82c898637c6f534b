#include "motion/dance/dynamics/waiting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/dance/standing.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::waiting_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }

Pose waiting(const WaitingMoment& moment) {
    Pose pose = idle_pose(body(), moment.time);
    wait(body(), moment, pose);
    return pose;
}

glm::vec3 head_of(const Pose& pose) { return world_pose(body(), pose).position(Bone::head); }

TEST(Waiting, is_alive_but_the_feet_stay) {
    const WorldPose stands = world_pose(body(), idle_pose(body(), StreamTime{}));
    float least = 1.0F;
    float most = -1.0F;
    std::vector<Pose> poses;
    for (int hop = 0; hop < 4000; ++hop) {
        poses.push_back(waiting({stream_time_from_seconds(0.01 * hop), 3, 0.5F, 0.02 * hop}));
        const WorldPose world = world_pose(body(), poses.back());
        for (const Bone foot : {Bone::left_foot, Bone::right_foot}) {
            ASSERT_LT(glm::distance(world.position(foot), stands.position(foot)), 0.003F) << hop;
        }
        least = std::min(least, poses.back().hips_position.x);
        most = std::max(most, poses.back().hips_position.x);
    }
    EXPECT_GT(most - least, 0.06F) << "the weight goes from leg to leg";
    EXPECT_LT(test::largest_step(poses, 0, 4000), 0.02);
}

TEST(Waiting, nods_on_the_beat_once_it_is_felt) {
    WaitingMoment moment;
    moment.felt = 1.0F;
    moment.beat = 4.0;
    const float on = head_of(waiting(moment)).y;
    moment.beat = 4.5;
    const float between = head_of(waiting(moment)).y;
    EXPECT_LT(on, between - 0.008F);
    moment.felt = 0.0F;
    EXPECT_EQ(head_of(waiting(moment)).y, between) << "who feels nothing does not move with it";
}

TEST(Waiting, a_bow_goes_down_and_comes_up) {
    WaitingMoment moment;
    const glm::vec3 upright = head_of(waiting(moment));
    moment.bowing = 0.95;
    const glm::vec3 bowed = head_of(waiting(moment));
    EXPECT_GT(bowed.z, upright.z + 0.15F);
    EXPECT_LT(bowed.y, upright.y - 0.05F);
    moment.bowing = kBowSeconds;
    EXPECT_LT(glm::distance(head_of(waiting(moment)), upright), 1e-3F);
}

}  // namespace
}  // namespace raks::motion::waiting_test
