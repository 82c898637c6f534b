#include "motion/capture/camera/rotation.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::capture {

namespace {

// Below it sin(a) / a is 1 and (1 - cos(a)) / a^2 is 1/2, to the last bit.
constexpr double kSmallAngle = 1e-8;

}  // namespace

glm::dmat3 rotation_of(const glm::dvec3& vector) noexcept {
    const double angle = glm::length(vector);
    const double sine = angle < kSmallAngle ? 1.0 : std::sin(angle) / angle;
    const double half = 0.5 * angle;
    const double half_sine = half < kSmallAngle ? 1.0 : std::sin(half) / half;
    const double cosine = 0.5 * half_sine * half_sine;  // (1 - cos(a)) / a^2, without cancelling
    const glm::dmat3 cross(
        {0.0, vector.z, -vector.y}, {-vector.z, 0.0, vector.x}, {vector.y, -vector.x, 0.0});
    return glm::dmat3(1.0) + sine * cross + cosine * (cross * cross);
}

glm::dvec3 rotation_vector(const glm::dmat3& rotation) noexcept {
    glm::dquat turn = glm::normalize(glm::quat_cast(rotation));
    if (turn.w < 0.0) {
        turn = -turn;
    }
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    const double scale = sine < kSmallAngle ? 2.0 : 2.0 * std::atan2(sine, turn.w) / sine;
    return scale * axis;
}

}  // namespace raks::capture
