#include "motion/skeleton/skeleton.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/skeleton/pose_track.hpp"

namespace raks::motion {
namespace {

Pose pose_number(int n) {
    Pose pose;
    pose.hips_position = {static_cast<float>(n), 1.0F, 0.0F};
    return pose;
}

TEST(Humanoid, parents_come_first_and_mirror_maps_names) {
    for (int i = 1; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        EXPECT_LT(kBoneParents[index_of(bone)], i);
        std::string name(kBoneNames[index_of(bone)]);
        if (name.rfind("left", 0) == 0) {
            EXPECT_EQ(kBoneNames[index_of(mirrored(bone))], "right" + name.substr(4));
        }
        EXPECT_EQ(mirrored(mirrored(bone)), bone);
    }
}

TEST(Skeleton, t_pose_stands_on_the_floor_and_faces_forward) {
    Pose pose;
    pose.hips_position = mannequin_skeleton().offsets[0];
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    EXPECT_GT(world.position(Bone::left_hand).x, 0.6F);
    EXPECT_GT(world.position(Bone::left_toes).z, world.position(Bone::left_foot).z);
    for (const Side side : kSides) {
        EXPECT_NEAR(foot_point(world, side, mannequin_skeleton().ball).y, 0.0F, 1e-5F);
    }
    EXPECT_NEAR(world.position(Bone::head).y, 1.49F, 1e-4F);
}

TEST(Skeleton, a_mirrored_pose_mirrors_places) {
    Pose pose;
    pose.hips_position = {0.1F, 0.9F, 0.2F};
    pose.rotation(Bone::hips) = glm::angleAxis(0.4F, glm::normalize(glm::vec3(0.2F, 1, 0.3F)));
    pose.rotation(Bone::left_upper_arm) = glm::angleAxis(-1.0F, glm::vec3(0, 0, 1));
    pose.rotation(Bone::right_lower_leg) = glm::angleAxis(0.7F, glm::vec3(1, 0, 0));
    const WorldPose a = world_pose(mannequin_skeleton(), pose);
    const WorldPose b = world_pose(mannequin_skeleton(), mirrored(pose));
    for (int i = 0; i < kBoneCount; ++i) {
        const glm::vec3 p = a.positions[static_cast<std::size_t>(i)];
        const glm::vec3 q = b.position(mirrored(static_cast<Bone>(i)));
        EXPECT_NEAR(p.x, -q.x, 1e-5F) << kBoneNames[static_cast<std::size_t>(i)];
        EXPECT_NEAR(p.y, q.y, 1e-5F);
        EXPECT_NEAR(p.z, q.z, 1e-5F);
    }
}

TEST(Skeleton, the_body_alone_lies_where_it_lies_with_its_fingers) {
    Pose pose = pose_number(1);
    for (std::size_t i = 0; i < pose.local_rotations.size(); ++i) {
        pose.local_rotations[i] = glm::angleAxis(0.1F * static_cast<float>(i), glm::vec3(0, 0, 1));
    }
    const WorldPose whole = world_pose(mannequin_skeleton(), pose);
    const WorldPose body = world_body(mannequin_skeleton(), pose);
    std::size_t placed = 0;
    for (std::size_t i = 0; i < kBoneNames.size(); ++i) {
        const std::string_view name = kBoneNames[i];
        const bool is_finger = name.ends_with("Proximal") || name.ends_with("Intermediate") ||
                               name.ends_with("Distal") || name.ends_with("Metacarpal");
        const bool is_middle = name.find("MiddleProximal") != std::string_view::npos ||
                               name.find("MiddleIntermediate") != std::string_view::npos;
        if (!is_finger || is_middle) {
            EXPECT_EQ(body.positions[i], whole.positions[i]) << name;
            EXPECT_EQ(body.rotations[i], whole.rotations[i]) << name;
            ++placed;
        }
    }
    EXPECT_EQ(placed, 26U);
}

TEST(PoseTrack, keeps_600_ms_final_and_200_ms_predicted) {
    PoseTrack track;
    EXPECT_TRUE(track.is_empty());
    for (int hop = 0; hop < 200; ++hop) {
        track.append_final(hop, pose_number(hop));
        for (int ahead = 1; ahead <= PoseTrack::kPredictedPoses; ++ahead) {
            track.set_predicted(ahead, pose_number(hop + ahead));
        }
    }
    EXPECT_EQ(track.newest_final(), 199);
    EXPECT_EQ(track.oldest_final(), 140);
    EXPECT_EQ(track.newest(), 219);
    for (HopIndex hop = 140; hop <= 219; ++hop) {
        EXPECT_EQ(track.at_hop(hop).hips_position.x, static_cast<float>(hop));
    }
    EXPECT_EQ(track.at_hop(0).hips_position.x, 140.0F);
    EXPECT_EQ(track.at_hop(900).hips_position.x, 219.0F);
}

TEST(PoseTrack, interpolates_between_hops_and_clamps_outside) {
    PoseTrack track;
    for (int hop = 0; hop < 10; ++hop) {
        track.append_final(hop, pose_number(hop));
    }
    EXPECT_NEAR(track.at(stream_time_from_seconds(0.0525)).hips_position.x, 5.25F, 1e-4F);
    EXPECT_EQ(track.at(stream_time_from_seconds(-1)).hips_position.x, 0.0F);
    EXPECT_EQ(track.at(stream_time_from_seconds(5)).hips_position.x, 9.0F);
}

TEST(Pose, between_two_of_a_list_is_their_share_and_held_at_both_ends) {
    std::vector<Pose> poses(3);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].hips_position.x = static_cast<float>(i * i);
    }
    const auto x = [&](double index) { return pose_between(poses, index).hips_position.x; };
    EXPECT_EQ(x(1.0), 1.0F);
    EXPECT_EQ(x(0.25), 0.25F);
    EXPECT_EQ(x(1.5), 2.5F);
    EXPECT_EQ(x(2.0), 4.0F);
    EXPECT_EQ(x(-3.0), 0.0F);
    EXPECT_EQ(x(9.0), 4.0F);
    EXPECT_EQ(pose_between(std::span(poses).first(1), 0.7).hips_position.x, 0.0F);
}

TEST(Pose, interpolation_takes_the_shorter_arc) {
    Pose a;
    Pose b;
    b.rotation(Bone::head) = -glm::angleAxis(0.2F, glm::vec3(0, 1, 0));  // the same rotation
    const glm::quat half = interpolate(a, b, 0.5F).rotation(Bone::head);
    EXPECT_NEAR(glm::angle(half), 0.1F, 1e-4F);
}

}  // namespace
}  // namespace raks::motion
