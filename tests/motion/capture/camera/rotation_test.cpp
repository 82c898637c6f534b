#include "motion/capture/camera/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

double difference(const glm::dmat3& a, const glm::dmat3& b) {
    double most = 0.0;
    for (glm::length_t i = 0; i < 9; ++i) {
        most = std::max(most, std::abs(a[i / 3][i % 3] - b[i / 3][i % 3]));
    }
    return most;
}

TEST(RotationVector, turns_about_its_axis_by_its_length) {
    const glm::dmat3 quarter = rotation_of({0.0, 0.0, 0.5 * std::numbers::pi});
    EXPECT_LT(glm::distance(quarter * glm::dvec3(1.0, 0.0, 0.0), {0.0, 1.0, 0.0}), 1e-15);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
    for (const double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.0, std::numbers::pi}) {
        const glm::dmat3 expected = glm::mat3_cast(glm::angleAxis(angle, axis));
        EXPECT_LT(difference(rotation_of(angle * axis), expected), 1e-15) << angle;
    }
}

TEST(RotationVector, and_matrix_are_inverses_up_to_half_a_turn) {
    for (const double angle : {0.0, 1e-10, 1e-6, 0.1, 1.5, 3.1, 3.141592}) {
        for (const glm::dvec3& axis :
             {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, -1.0, 0.0), glm::dvec3(-1.0, 2.0, 3.0)}) {
            const glm::dvec3 vector = angle * glm::normalize(axis);
            EXPECT_LT(glm::distance(rotation_vector(rotation_of(vector)), vector), 1e-14) << angle;
        }
    }
}

}  // namespace
}  // namespace raks::capture
