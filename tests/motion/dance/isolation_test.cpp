#include "motion/dance/dynamics/isolation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion::isolation_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }

// Hips that sway sideways by 5 cm with all that is over them.
Pose swaying(double turn) {
    Pose pose;
    pose.hips_position = {0.05F * static_cast<float>(std::sin(turn)), 0.9F, 0.0F};
    pose.rotation(Bone::left_upper_arm) = glm::angleAxis(-0.8F, glm::vec3(0, 0, 1));
    return pose;
}

Pose middle() { return swaying(0.0); }

float way_of(StillPart part, Bone bone) {
    float least = 1.0F;
    float most = -1.0F;
    for (int i = 0; i < 64; ++i) {
        Pose pose = swaying(0.1 * i);
        keep_still(body(), part, middle(), pose);
        const float x = world_pose(body(), pose).position(bone).x;
        least = std::min(least, x);
        most = std::max(most, x);
    }
    return most - least;
}

TEST(Isolation, a_head_that_is_to_stay_goes_at_most_two_fifths_of_the_way_of_the_hips) {
    EXPECT_GT(way_of(StillPart::nothing, Bone::head), 0.099F);
    EXPECT_GT(way_of(StillPart::head, Bone::hips), 0.099F);
    EXPECT_LT(way_of(StillPart::head, Bone::head), 0.04F);
    EXPECT_LT(way_of(StillPart::chest, Bone::neck), 0.04F);
}

TEST(Isolation, arms_and_head_keep_their_directions) {
    const Pose before = swaying(1.2);
    Pose after = before;
    keep_still(body(), StillPart::head, middle(), after);
    const WorldPose was = world_pose(body(), before);
    const WorldPose is = world_pose(body(), after);
    EXPECT_NE(is.rotation(Bone::upper_chest), was.rotation(Bone::upper_chest));
    for (const Bone bone : {Bone::head, Bone::left_upper_arm, Bone::right_lower_arm}) {
        EXPECT_GT(std::abs(glm::dot(is.rotation(bone), was.rotation(bone))), 1.0F - 1e-5F)
            << kBoneNames[index_of(bone)];
    }
}

TEST(Isolation, nothing_that_stays_changes_nothing) {
    Pose pose = swaying(1.0);
    keep_still(body(), StillPart::nothing, middle(), pose);
    EXPECT_EQ(pose.local_rotations, swaying(1.0).local_rotations);
}

}  // namespace
}  // namespace raks::motion::isolation_test
