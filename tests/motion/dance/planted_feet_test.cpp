#include "motion/dance/dynamics/planted_feet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/standing.hpp"

#include <glm/geometric.hpp>

namespace raks::motion::planted_feet_test {
namespace {

const Skeleton& body() { return mannequin_skeleton(); }

// Stands at a place; from hop 200 to 260 it steps aside with the left foot, by 0.3 m, and back.
Pose stepping(int hop, const glm::dvec2& place) {
    Pose pose = FloorMove{0.0, place}(idle_pose(body(), StreamTime{}));
    const float share = static_cast<float>(hop - 200) / 60.0F;
    if (share > 0.0F && share < 1.0F) {
        const WorldPose world = world_pose(body(), pose);
        const auto out = static_cast<float>(std::sin(M_PI * static_cast<double>(share)));
        FootTarget target{world.position(Bone::left_foot), world.rotation(Bone::left_foot)};
        target.ankle += glm::vec3(0.3F * out, 0.06F * out, 0.0F);
        solve_leg(body(), Side::left, target, pose);
        pose.foot_contact[0] = false;
    }
    return pose;
}

glm::vec3 foot_of(const Pose& pose, Side side) {
    return foot_place(body(), world_pose(body(), pose), side).pivot;
}

PlantedFeet carried_over(const glm::dvec2& from, const glm::dvec2& to) {
    PlantedFeet feet;
    const Pose shown = stepping(0, from);
    const Pose next = stepping(0, to);
    feet.carry_over(body(), shown, shown, next, next);
    return feet;
}

TEST(PlantedFeet, nothing_changes_without_a_lag) {
    PlantedFeet feet;
    for (int hop = 0; hop < 300; ++hop) {
        const Pose wanted = stepping(hop, {0.0, 0.0});
        const Pose pose = feet.apply(body(), wanted);
        ASSERT_EQ(pose.local_rotations, wanted.local_rotations) << hop;
    }
}

TEST(PlantedFeet, a_standing_foot_keeps_its_place_when_the_motion_changes) {
    PlantedFeet feet = carried_over({0.04, 0.0}, {0.0, 0.0});
    const glm::vec3 before = foot_of(stepping(0, {0.04, 0.0}), Side::right);
    for (int hop = 1; hop < 200; ++hop) {
        const Pose pose = feet.apply(body(), stepping(hop, {0.0, 0.0}));
        ASSERT_LT(glm::distance(foot_of(pose, Side::right), before), 0.004F) << hop;
        EXPECT_NEAR(pose.hips_position.x, 0.04F, 0.005F) << "the hips stay between the feet";
    }
}

TEST(PlantedFeet, a_swinging_foot_makes_up_what_it_lags) {
    PlantedFeet feet = carried_over({0.04, 0.0}, {0.0, 0.0});
    Pose pose;
    for (int hop = 1; hop < 300; ++hop) {
        pose = feet.apply(body(), stepping(hop, {0.0, 0.0}));
    }
    const Pose wanted = stepping(299, {0.0, 0.0});
    EXPECT_LT(glm::distance(foot_of(pose, Side::left), foot_of(wanted, Side::left)), 0.002F);
    EXPECT_GT(glm::distance(foot_of(pose, Side::right), foot_of(wanted, Side::right)), 0.03F)
        << "the other has not swung, and lags too little for a step of its own";
}

TEST(PlantedFeet, a_foot_that_is_left_standing_far_off_steps_over_and_does_not_slide) {
    PlantedFeet feet = carried_over({0.15, 0.0}, {0.0, 0.0});
    Pose before = stepping(0, {0.15, 0.0});
    int lifted = 0;
    for (int hop = 1; hop < 195; ++hop) {
        const Pose pose = feet.apply(body(), stepping(hop, {0.0, 0.0}));
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            if (pose.foot_contact[s] && before.foot_contact[s]) {
                glm::vec3 slid = foot_of(pose, side) - foot_of(before, side);
                slid.y = 0.0F;
                ASSERT_LT(glm::length(slid), 0.003F) << hop;
            }
        }
        lifted += pose.foot_contact[0] && pose.foot_contact[1] ? 0 : 1;
        ASSERT_TRUE(pose.foot_contact[0] || pose.foot_contact[1]) << "one after the other";
        before = pose;
    }
    EXPECT_GT(lifted, 40);
    EXPECT_NEAR(before.hips_position.x, stepping(0, {0.0, 0.0}).hips_position.x, 0.01F);
}

TEST(PlantedFeet, whoever_holds_still_takes_no_step_of_its_own) {
    PlantedFeet feet = carried_over({0.15, 0.0}, {0.0, 0.0});
    const Pose wanted = stepping(0, {0.0, 0.0});
    for (int hop = 1; hop < 195; ++hop) {
        const Pose pose = feet.apply(body(), wanted, PlantedFeet::OwnSteps::wait);
        ASSERT_TRUE(pose.foot_contact[0] && pose.foot_contact[1]) << hop;
    }
    bool has_stepped = false;
    for (int hop = 195; hop < 300; ++hop) {
        has_stepped = has_stepped || !feet.apply(body(), wanted).foot_contact[0];
    }
    EXPECT_TRUE(has_stepped) << "afterwards it does";
}

}  // namespace
}  // namespace raks::motion::planted_feet_test
