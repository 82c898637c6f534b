#include "motion/figures/motion_features.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "tests/motion/figures/small_figure.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion {
namespace {

glm::dquat random_rotation(const CounterRandom& random, std::uint64_t at) {
    const glm::dquat q(random.normal(4 * at),
                       random.normal(4 * at + 1),
                       random.normal(4 * at + 2),
                       random.normal(4 * at + 3));
    return glm::normalize(q);
}

double angle_between(const glm::quat& a, const glm::quat& b) {
    return 2.0 * std::asin(std::min(
                     1.0,
                     static_cast<double>(glm::length(glm::vec3((glm::conjugate(a) * b).x,
                                                               (glm::conjugate(a) * b).y,
                                                               (glm::conjugate(a) * b).z)))));
}

/// Poses that wander, turn through more than a whole turn, and bend everywhere.
std::vector<Pose> wandering_poses(std::size_t count) {
    const CounterRandom random(3);
    std::vector<Pose> poses(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / 10.0;
        Pose& pose = poses[i];
        pose.hips_position = {static_cast<float>(std::sin(t)),
                              static_cast<float>(0.9 + 0.05 * std::cos(3 * t)),
                              static_cast<float>(0.3 * t)};
        pose.rotation(Bone::hips) =
            glm::angleAxis(static_cast<float>(1.3 * t), glm::vec3(0, 1, 0)) *
            glm::angleAxis(static_cast<float>(0.4 * std::sin(t)),
                           glm::normalize(glm::vec3(1, 0, 0.5F)));
        for (const Part part : kParts) {
            for (const Bone bone : default_joints(part)) {
                const double angle = 1.2 * random.normal(static_cast<std::uint64_t>(bone)) *
                                     std::sin(t + static_cast<double>(index_of(bone)));
                pose.rotation(bone) = glm::angleAxis(static_cast<float>(angle),
                                                     glm::normalize(glm::vec3(1, 0.3F, -0.2F)));
            }
        }
    }
    return poses;
}

PartModel layout(Part part) {
    const CounterRandom random(4, static_cast<std::uint64_t>(part));
    PartModel model;
    model.part = part;
    for (const Bone bone : default_joints(part)) {
        // A mean that is not the identity, within half a turn of everything.
        const glm::dvec3 small(0.3 * random.uniform(0), 0.2, -0.1);
        model.joints.push_back({bone, rotation_from(small)});
    }
    return model;
}

TEST(ExponentialMap, is_inverted_by_rotation_from) {
    const CounterRandom random(1);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const glm::dquat q = random_rotation(random, i);
        const glm::dquat back = rotation_from(exponential_map(q));
        EXPECT_NEAR(std::abs(glm::dot(q, back)), 1.0, 1e-12);
    }
    EXPECT_EQ(exponential_map({1, 0, 0, 0}), glm::dvec3(0.0));
    EXPECT_NEAR(exponential_map(rotation_from({1e-9, 0, 0})).x, 1e-9, 1e-20);
    EXPECT_NEAR(glm::length(exponential_map(rotation_from({0, 3.1, 0}))), 3.1, 1e-12);
}

TEST(Heading, takes_the_whole_turn_about_the_vertical) {
    const glm::dquat tilt = rotation_from({0.3, 0.0, -0.2});
    for (double heading = -3.0; heading < 3.1; heading += 0.5) {
        EXPECT_NEAR(heading_of(rotation_from({0, heading, 0}) * tilt), heading, 1e-12);
    }
}

TEST(MeanRotation, lies_between_and_ignores_signs) {
    const std::vector<glm::dquat> two = {rotation_from({0.2, 0, 0}), -rotation_from({0.6, 0, 0})};
    const glm::dvec3 mean = exponential_map(mean_rotation(two, std::vector<double>{1.0, 1.0}));
    EXPECT_NEAR(mean.x, 0.4, 1e-12);
    const glm::dvec3 first = exponential_map(mean_rotation(two, std::vector<double>{1.0, 0.0}));
    EXPECT_NEAR(first.x, 0.2, 1e-12);
}

TEST(MotionFeatures, are_inverted_within_1e_5) {
    const std::vector<Pose> poses = wandering_poses(120);
    const PartModel torso = layout(Part::torso);
    const FeatureTrack root = features_of(poses, torso, 24);
    ASSERT_EQ(root.columns, 15U);
    const RootPlace start{{static_cast<double>(poses[0].hips_position.x),
                           static_cast<double>(poses[0].hips_position.z)},
                          heading_of(glm::dquat(poses[0].rotation(Bone::hips)))};
    const std::vector<RootPlace> places = integrate_root(root, 24, start);
    std::vector<Pose> rebuilt(poses.size());
    for (const Part part : kParts) {
        const PartModel model = layout(part);
        const FeatureTrack track = features_of(poses, model, 24);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            apply_features(track.row(i), model, places[i], 1.0, rebuilt[i]);
        }
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
            EXPECT_LT(
                angle_between(poses[i].local_rotations[bone], rebuilt[i].local_rotations[bone]),
                1e-5)
                << "pose " << i << ", " << kBoneNames[bone];
        }
        EXPECT_LT(glm::length(poses[i].hips_position - rebuilt[i].hips_position), 1e-5F) << i;
    }
}

TEST(MotionFeatures, know_neither_place_nor_direction_of_the_dance) {
    const std::vector<Pose> poses = wandering_poses(40);
    std::vector<Pose> elsewhere = poses;
    const glm::quat turn = glm::angleAxis(2.0F, glm::vec3(0, 1, 0));
    for (Pose& pose : elsewhere) {
        pose.hips_position = turn * pose.hips_position + glm::vec3(3, 0, -2);
        pose.rotation(Bone::hips) = turn * pose.rotation(Bone::hips);
    }
    const FeatureTrack a = features_of(poses, layout(Part::torso), 24);
    const FeatureTrack b = features_of(elsewhere, layout(Part::torso), 24);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        // Places of some metres in floats, times 24 samples a beat.
        EXPECT_NEAR(a.values[i], b.values[i], 5e-5);
    }
}

TEST(IntegrateRoot, ends_where_the_net_motion_says) {
    const FeatureTrack root = features_of(wandering_poses(97), layout(Part::torso), 24);
    const NetMotion net{{0.3, -0.1}, 0.7};
    const RootPlace start{{1.0, 2.0}, 0.5};
    for (const double scale : {1.0, 1.2}) {
        const std::vector<RootPlace> places = integrate_root(root, 24, start, scale, net);
        ASSERT_EQ(places.size(), 98U);
        EXPECT_EQ(places[0].position, start.position);
        EXPECT_NEAR(places[97].heading, 1.2, 1e-12);
        const double c = std::cos(0.5);
        const double s = std::sin(0.5);
        EXPECT_NEAR(places[97].position.x, 1.0 + scale * (c * 0.3 - s * 0.1), 1e-12);
        EXPECT_NEAR(places[97].position.y, 2.0 + scale * (-c * 0.1 - s * 0.3), 1e-12);
    }
}

TEST(MotionFeatures, are_applied_without_allocation) {
    const PartModel model = layout(Part::torso);
    const FeatureTrack track = features_of(wandering_poses(4), model, 24);
    Pose pose;
    raks::test::RealtimeScope scope;
    apply_features(track.row(0), model, {}, 1.0, pose);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::motion
