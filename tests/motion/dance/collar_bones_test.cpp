#include "motion/dance/body/collar_bones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion::collar_bones_test {
namespace {

// Both shoulders' joints over the base of the neck, along the spine, at a leg of 0.83 m; metres.
std::array<float, 2> rises(const Skeleton& skeleton, const Pose& pose) {
    const WorldPose world = world_pose(skeleton, pose);
    const float leg = glm::length(skeleton.offsets[index_of(Bone::left_lower_leg)]) +
                      glm::length(skeleton.offsets[index_of(Bone::left_foot)]);
    const glm::vec3 up =
        glm::normalize(world.position(Bone::neck) - world.position(Bone::upper_chest));
    std::array<float, 2> result{};
    for (const Side side : kSides) {
        const glm::vec3 from_neck =
            world.position(on_side(Bone::left_upper_arm, side)) - world.position(Bone::neck);
        result[static_cast<std::size_t>(side)] = glm::dot(from_neck, up) * 0.83F / leg;
    }
    return result;
}

// Shoulders raised by so many radians, one arm stretched out, the trunk turned.
Pose raised(float left, float right) {
    Pose pose;
    pose.rotation(Bone::spine) = glm::angleAxis(0.4F, glm::normalize(glm::vec3(0.3F, 1, 0.5F)));
    pose.rotation(Bone::left_shoulder) = glm::angleAxis(left, glm::vec3(0, 0, 1));
    pose.rotation(Bone::right_shoulder) = glm::angleAxis(-right, glm::vec3(0, 0, 1));
    pose.rotation(Bone::left_upper_arm) = glm::angleAxis(0.7F, glm::vec3(0, 1, 0));
    return pose;
}

TEST(CollarBones, shoulders_stay_beside_the_neck_and_differ_little_on_bodies_of_any_size) {
    for (const float size : {0.5F, 1.0F, 1.8F}) {
        const Skeleton skeleton = scaled(mannequin_skeleton(), size);
        for (float left = -0.8F; left < 1.3F; left += 0.1F) {
            for (float right = -0.8F; right < 1.3F; right += 0.1F) {
                Pose pose = raised(left, right);
                limit_collar_bones(skeleton, pose);
                const std::array<float, 2> after = rises(skeleton, pose);
                EXPECT_LT(std::max(after[0], after[1]), 0.02F) << left << ' ' << right;
                EXPECT_LT(std::abs(after[0] - after[1]), 0.0801F) << left << ' ' << right;
            }
        }
    }
}

TEST(CollarBones, shoulders_within_their_limits_stay_and_arms_keep_their_directions) {
    const Skeleton& skeleton = mannequin_skeleton();
    Pose quiet = raised(0.1F, 0.0F);
    limit_collar_bones(skeleton, quiet);
    EXPECT_EQ(quiet.local_rotations, raised(0.1F, 0.0F).local_rotations);

    const Pose wild = raised(1.2F, -0.5F);
    Pose pose = wild;
    limit_collar_bones(skeleton, pose);
    const glm::quat before = world_pose(skeleton, wild).rotation(Bone::left_upper_arm);
    const glm::quat after = world_pose(skeleton, pose).rotation(Bone::left_upper_arm);
    EXPECT_GT(std::abs(glm::dot(before, after)), 1.0F - 1e-5F);
}

TEST(CollarBones, a_shoulder_that_rises_evenly_never_leaps) {
    const Skeleton& skeleton = mannequin_skeleton();
    float last = 0.0F;
    for (int i = 0; i <= 1000; ++i) {
        Pose pose = raised(-0.2F + 0.0015F * static_cast<float>(i), 0.0F);
        limit_collar_bones(skeleton, pose);
        const float now = rises(skeleton, pose)[0];
        if (i > 0) {
            // The collar bone is 0.14 m long.
            EXPECT_LT(std::abs(now - last), 0.0015F * 0.15F) << i;
        }
        last = now;
    }
}

TEST(CollarBones, a_body_without_collar_bones_is_left_as_it_is) {
    Skeleton skeleton = mannequin_skeleton();
    for (const Side side : kSides) {
        skeleton.offsets[index_of(on_side(Bone::left_upper_arm, side))] = {};
    }
    Pose pose = raised(1.0F, 0.0F);
    limit_collar_bones(skeleton, pose);
    EXPECT_TRUE(is_finite(pose));
}

}  // namespace
}  // namespace raks::motion::collar_bones_test
