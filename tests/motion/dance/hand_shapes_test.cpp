#include "motion/dance/dynamics/hand_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::hand_shapes_test {
namespace {

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

Pose shaped(HandShape shape, double beat = 0.0) {
    Pose pose;
    for (const Side side : kSides) {
        set_hand_shape(side, shape, beat, pose);
    }
    return pose;
}

// From the wrist to the last joint of a finger; metres.
float reach(const Pose& pose, Bone left_distal) {
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    return glm::distance(world.position(Bone::left_hand), world.position(left_distal));
}

float between(const Pose& pose, Bone one, Bone other) {
    const WorldPose world = world_pose(mannequin_skeleton(), pose);
    return glm::distance(world.position(one), world.position(other));
}

TEST(HandShapes, shapes_look_as_they_are_called) {
    const Pose fist = shaped(HandShape::fist);
    const Pose flat = shaped(HandShape::flat);
    const Pose open = shaped(HandShape::open);
    const Pose point = shaped(HandShape::point);
    for (const Bone finger : {Bone::left_middle_distal, Bone::left_little_distal}) {
        EXPECT_LT(reach(fist, finger), 0.7F * reach(flat, finger));
        EXPECT_LT(reach(point, finger), 0.7F * reach(flat, finger));
    }
    EXPECT_GT(reach(point, Bone::left_index_distal), 0.95F * reach(flat, Bone::left_index_distal));
    EXPECT_GT(between(open, Bone::left_index_distal, Bone::left_little_distal),
              1.4F * between(flat, Bone::left_index_distal, Bone::left_little_distal));
    EXPECT_LT(
        between(shaped(HandShape::lengthy), Bone::left_thumb_distal, Bone::left_index_proximal),
        between(open, Bone::left_thumb_distal, Bone::left_index_proximal))
        << "the thumb in";
}

TEST(HandShapes, the_right_hand_is_the_mirror_image_of_the_left_one) {
    for (std::size_t shape = 0; shape < kHandShapeNames.size(); ++shape) {
        const Pose pose = shaped(static_cast<HandShape>(shape), 0.4);
        EXPECT_EQ(mirrored(pose).local_rotations, pose.local_rotations) << kHandShapeNames[shape];
    }
}

TEST(HandShapes, fingers_snap_on_off_beats_and_zills_strike_on_all_beats) {
    const auto snapped = [](double beat) {
        return reach(shaped(HandShape::snap, beat), Bone::left_middle_distal);
    };
    EXPECT_LT(snapped(1.0), 0.9F * snapped(0.0));
    EXPECT_LT(snapped(3.0), 0.9F * snapped(2.0));
    EXPECT_NEAR(snapped(1.0), snapped(3.0), 1e-5F);
    const auto apart = [](double beat) {
        return between(
            shaped(HandShape::zills, beat), Bone::left_thumb_distal, Bone::left_middle_distal);
    };
    for (const double beat : {0.0, 1.0, 2.0}) {
        EXPECT_LT(apart(beat), 0.9F * apart(beat + 0.6)) << beat;
    }
}

TEST(HandShapes, a_change_is_eased_and_over_after_its_time) {
    HandShapes hands;
    Pose shown = shaped(HandShape::relaxed);
    float fastest = 0.0F;
    for (int hop = 0; hop < 60; ++hop) {
        if (hop == 20) {
            hands.take(Side::left, HandShape::fist, at(0.01 * hop), shown);
        }
        Pose pose = shaped(HandShape::relaxed);
        hands.apply(at(0.01 * hop), 0.0, pose);
        const glm::quat& last = shown.rotation(Bone::left_middle_proximal);
        const glm::quat& now = pose.rotation(Bone::left_middle_proximal);
        fastest =
            std::max(fastest, 2.0F * std::acos(std::min(1.0F, std::abs(glm::dot(last, now)))));
        if (hop == 20) {
            EXPECT_GT(std::abs(glm::dot(last, now)), 1.0F - 1e-5F) << "it begins where it was";
        }
        shown = pose;
    }
    EXPECT_LT(fastest, 0.2F) << "radians in a hop";
    EXPECT_EQ(shown.rotation(Bone::left_middle_proximal),
              shaped(HandShape::fist).rotation(Bone::left_middle_proximal));
    EXPECT_EQ(shown.rotation(Bone::right_middle_proximal),
              shaped(HandShape::relaxed).rotation(Bone::right_middle_proximal))
        << "the other hand stays";
}

TEST(HandShapes, hands_as_danced_are_left_as_they_are) {
    const HandShapes hands;
    Pose pose;
    pose.rotation(Bone::left_index_proximal) = glm::angleAxis(0.3F, glm::vec3(0, 0, -1));
    const Pose before = pose;
    hands.apply(at(1.0), 0.0, pose);
    EXPECT_EQ(pose.local_rotations, before.local_rotations);
}

}  // namespace
}  // namespace raks::motion::hand_shapes_test
