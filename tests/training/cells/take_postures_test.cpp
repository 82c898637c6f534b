#include "training/cells/take_postures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace raks::motion {
namespace {

constexpr double kRate = 60.0;

/// How the arms of a body are held.
struct Arms {
    glm::dvec3 elbow;  // of the left, from its shoulder
    glm::dvec3 hand;   // of the left, from its elbow
};
constexpr Arms kForward = {{0.0, -0.3, 0.0}, {0.0, -0.1, 0.25}};
constexpr Arms kSpread = {{0.3, 0.0, 0.0}, {0.25, 0.0, 0.0}};
constexpr Arms kRaised = {{0.1, 0.3, 0.0}, {0.0, 0.25, 0.0}};

/// Seconds of a body with such arms; all joints go at a speed, hands besides at one of their own.
void add(
    double seconds, const Arms& arms, double speed, double hands, std::vector<TakeMoment>& to) {
    TakeMoment moment;
    moment.velocities.fill({0.0, speed, 0.0});
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const glm::dvec3 mirror(side == 0 ? 1.0 : -1.0, 1.0, 1.0);
        moment.places[3 + side] = mirror * glm::dvec3(0.2, 1.4, 0.0);
        moment.places[5 + side] = moment.places[3 + side] + mirror * arms.elbow;
        moment.places[7 + side] = moment.places[5 + side] + mirror * arms.hand;
        moment.velocities[7 + side].x = hands;
    }
    to.insert(to.end(), static_cast<std::size_t>(seconds * kRate), moment);
}

TakePostures judged(const std::vector<TakeMoment>& moments) {
    return postures_of(moments, std::vector<Pose>(moments.size()), kRate);
}

double seconds_of(const std::vector<bool>& flags) {
    return static_cast<double>(std::count(flags.begin(), flags.end(), true)) / kRate;
}

TEST(TakePostures, still_ends_are_idle_and_a_short_stillness_is_a_hold) {
    std::vector<TakeMoment> take;
    add(1.5, kRaised, 0.05, 0.0, take);
    add(5.0, kRaised, 0.6, 0.0, take);
    add(1.5, kRaised, 0.05, 0.0, take);  // a hold
    add(5.0, kRaised, 0.6, 0.0, take);
    add(4.0, kRaised, 0.05, 0.0, take);  // nobody dances
    add(5.0, kRaised, 0.6, 0.0, take);
    const TakePostures postures = judged(take);
    EXPECT_TRUE(postures.is_idle.front());
    EXPECT_FALSE(postures.is_idle[static_cast<std::size_t>(7.25 * kRate)]);
    EXPECT_TRUE(postures.is_idle[static_cast<std::size_t>(15.0 * kRate)]);
    EXPECT_FALSE(postures.is_idle.back());
    EXPECT_NEAR(seconds_of(postures.is_idle), 5.5, 0.8);
}

TEST(TakePostures, forearms_that_point_ahead_and_rest_are_a_machines) {
    std::vector<TakeMoment> take;
    add(3.0, kForward, 0.6, 0.1, take);
    EXPECT_NEAR(seconds_of(judged(take).is_home), 3.0, 0.02);
    take.clear();
    add(3.0, kForward, 0.6, 2.0, take);
    EXPECT_EQ(seconds_of(judged(take).is_home), 0.0);
    take.clear();
    add(3.0, kRaised, 0.6, 0.1, take);
    EXPECT_EQ(seconds_of(judged(take).is_home), 0.0);
}

TEST(TakePostures, people_may_carry_their_arms_so) {
    std::vector<TakeMoment> take;
    add(3.0, kForward, 0.6, 0.1, take);
    std::vector<Pose> poses(take.size());
    poses.back().rotation(Bone::head) = glm::angleAxis(0.1F, glm::vec3(1, 0, 0));
    EXPECT_EQ(seconds_of(postures_of(take, poses, kRate).is_home), 0.0);
}

TEST(TakePostures, arms_are_held_spread_only_for_long) {
    std::vector<TakeMoment> take;
    add(2.0, kRaised, 0.6, 0.1, take);
    add(1.0, kSpread, 0.6, 0.1, take);
    add(2.0, kRaised, 0.6, 0.1, take);
    EXPECT_EQ(seconds_of(judged(take).is_spread), 0.0);
    add(4.0, kSpread, 0.6, 0.1, take);
    EXPECT_NEAR(seconds_of(judged(take).is_spread), 4.0, 0.1);
}

TEST(TakePostures, a_body_that_is_elsewhere_in_the_next_frame_leaps) {
    std::vector<TakeMoment> take;
    add(2.0, kRaised, 0.6, 0.1, take);
    std::vector<Pose> poses(take.size());
    for (std::size_t f = 60; f < poses.size(); ++f) {
        poses[f].hips_position.x = 0.5F;
    }
    poses[90].rotation(Bone::left_upper_arm) = glm::angleAxis(1.5F, glm::vec3(0, 0, 1));
    const TakePostures postures = postures_of(take, poses, kRate);
    EXPECT_EQ(std::count(postures.is_leap.begin(), postures.is_leap.end(), true), 3);
    EXPECT_TRUE(postures.is_leap[60] && postures.is_leap[90] && postures.is_leap[91]);
}

TEST(TakePostures, a_moving_mean_of_a_constant_is_the_constant) {
    const std::vector<double> values(20, 3.0);
    EXPECT_EQ(moving_mean(values, 7), values);
    EXPECT_EQ(moving_mean(std::vector{0.0, 3.0, 6.0}, 2), (std::vector{1.5, 3.0, 4.5}));
}

}  // namespace
}  // namespace raks::motion
