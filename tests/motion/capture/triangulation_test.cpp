#include "motion/capture/triangulation/triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/dice.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

Rig ring(int count, double distance, double f, double elevation) {
    const Lens lens{640, 480, f, f, 319.5, 239.5, {}};
    Rig rig;
    for (int i = 0; i < count; ++i) {
        const double angle = (count == 2 ? 1.5707963267948966 : 6.283185307179586 / count) * i;
        const glm::dvec3 centre(std::sin(angle) * std::cos(elevation),
                                std::sin(elevation),
                                std::cos(angle) * std::cos(elevation));
        rig.cameras.push_back(
            looking_at("c" + std::to_string(i), lens, distance * centre, {0.0, 0.0, 0.0}));
    }
    return rig;
}

std::vector<PointView> views_of(const Rig& rig, const glm::dvec3& point, double noise, Dice& dice) {
    std::vector<PointView> views;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        const glm::dvec2 pixel =
            *project(rig.cameras[i], point) + glm::dvec2(dice.normal(noise), dice.normal(noise));
        views.push_back({i, direction_of(rig.cameras[i].lens, pixel), {}, 1.0});
    }
    return views;
}

// RMS error of 3,000 points in the middle against the formula.
double ratio_to_formula(int count, double distance, double f, double sigma) {
    const Rig rig = ring(count, distance, f, 0.0);
    Dice dice(7, 1);
    double squares = 0.0;
    constexpr int kPoints = 3000;
    for (int i = 0; i < kPoints; ++i) {
        const auto point = triangulate(rig, views_of(rig, {0.0, 0.0, 0.0}, sigma, dice), sigma);
        EXPECT_TRUE(point);
        squares += point ? glm::dot(point->place, point->place) : 0.0;
    }
    return std::sqrt(squares / kPoints) / expected_error(distance, f, sigma, count);
}

TEST(Triangulation, errs_as_the_formula_says) {
    EXPECT_NEAR(ratio_to_formula(3, 4.0, 600.0, 1.0), 1.0, 0.03);
    EXPECT_NEAR(ratio_to_formula(4, 4.0, 600.0, 1.0), 1.0, 0.03);
    EXPECT_NEAR(ratio_to_formula(6, 4.0, 600.0, 1.0), 1.0, 0.03);
    EXPECT_NEAR(ratio_to_formula(8, 4.0, 600.0, 1.0), 1.0, 0.03);
    EXPECT_NEAR(ratio_to_formula(6, 3.0, 600.0, 0.5), 1.0, 0.03);
    EXPECT_LE(ratio_to_formula(6, 4.0, 600.0, 1.0) * expected_error(4.0, 600.0, 1.0, 6), 0.007);
}

TEST(Triangulation, its_covariance_is_that_of_its_errors) {
    const Rig rig = ring(6, 4.0, 600.0, 0.35);
    Dice dice(3, 2);
    double squares = 0.0;
    double promised = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 truth(dice.uniform(-1, 1), dice.uniform(-0.5, 1), dice.uniform(-1, 1));
        const auto point = triangulate(rig, views_of(rig, truth, 1.0, dice), 1.0);
        ASSERT_TRUE(point);
        const glm::dvec3 miss = point->place - truth;
        squares += glm::dot(miss, miss);
        promised += point->deviation() * point->deviation();
    }
    // Cauchy's weights make it a little too large.
    EXPECT_NEAR(std::sqrt(promised / squares), 1.1, 0.15);
}

TEST(Triangulation, drops_a_view_that_is_wrong) {
    const Rig rig = ring(5, 4.0, 600.0, 0.2);
    Dice dice(5, 3);
    std::vector<PointView> views = views_of(rig, {0.3, 0.2, -0.4}, 0.5, dice);
    views[2].direction.x += 40.0 / 600.0;
    const auto point = triangulate(rig, views, 0.5);
    ASSERT_TRUE(point);
    EXPECT_EQ(point->views, (std::vector<std::size_t>{0, 1, 3, 4}));
    EXPECT_LT(glm::distance(point->place, glm::dvec3(0.3, 0.2, -0.4)), 0.01);
}

TEST(Triangulation, takes_the_moments_of_the_views_into_account) {
    const Rig rig = ring(4, 4.0, 600.0, 0.2);
    Dice dice(5, 4);
    const glm::dvec3 velocity(1.0, -2.0, 0.5);
    std::vector<PointView> views;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 shift = velocity * dice.uniform(-0.01, 0.01);
        const glm::dvec2 pixel = *project(rig.cameras[i], glm::dvec3(0.1, 0.2, 0.3) + shift);
        views.push_back({i, direction_of(rig.cameras[i].lens, pixel), shift, 1.0});
    }
    const auto point = triangulate(rig, views, 1.0);
    ASSERT_TRUE(point);
    EXPECT_LT(glm::distance(point->place, glm::dvec3(0.1, 0.2, 0.3)), 1e-6);
}

TEST(Triangulation, needs_two_places_to_look_from) {
    const Rig rig = ring(3, 4.0, 600.0, 0.0);
    Dice dice(1, 5);
    const std::vector<PointView> views = views_of(rig, {0.0, 0.1, 0.0}, 0.0, dice);
    EXPECT_FALSE(triangulate(rig, std::span(views).first(1), 1.0));
    const std::vector<PointView> same = {views[0], views[0]};
    EXPECT_FALSE(triangulate(rig, same, 1.0));
}

}  // namespace
}  // namespace raks::capture
