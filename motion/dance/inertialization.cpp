#include "motion/dance/inertialization.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kForgotten = 2.0;  // seconds: 1e-4 of the difference is left

/// Rotation vector (axis x angle) of q as its sign says: of q and -q one is the shorter way round.
glm::vec3 rotation_vector(const glm::quat& q) noexcept {
    const glm::vec3 axis(q.x, q.y, q.z);
    const float sine = glm::length(axis);
    return sine < 1e-6F ? 2.0F * axis : axis * (2.0F * std::atan2(sine, q.w) / sine);
}

// The inverse; first order for small angles.
glm::quat rotation_of(const glm::vec3& vector) noexcept {
    const float angle = glm::length(vector);
    if (angle < 1e-6F) {
        return glm::normalize(glm::quat(1.0F, 0.5F * vector.x, 0.5F * vector.y, 0.5F * vector.z));
    }
    const float scale = std::sin(0.5F * angle) / angle;
    return {std::cos(0.5F * angle), scale * vector.x, scale * vector.y, scale * vector.z};
}

}  // namespace

void Inertialization::start(const Pose& shown,
                            const Pose& shown_before,
                            const Pose& next,
                            const Pose& next_before) noexcept RAKS_NONBLOCKING {
    const auto per_second = static_cast<float>(kHopsPerSecond);
    for (std::size_t i = 0; i < rotations_.size(); ++i) {
        glm::quat apart = shown.local_rotations[i] * glm::conjugate(next.local_rotations[i]);
        apart = apart.w < 0.0F ? -apart : apart;
        glm::quat apart_before =
            shown_before.local_rotations[i] * glm::conjugate(next_before.local_rotations[i]);
        // The same way round, though it was the longer one: else it would seem to have spun.
        apart_before = glm::dot(apart, apart_before) < 0.0F ? -apart_before : apart_before;
        const glm::vec3 now = rotation_vector(apart);
        rotations_[i] = {now, (now - rotation_vector(apart_before)) * per_second};
    }
    const glm::vec3 now = shown.hips_position - next.hips_position;
    const glm::vec3 before = shown_before.hips_position - next_before.hips_position;
    hips_ = {now, (now - before) * per_second};
    is_active_ = true;
}

bool Inertialization::is_active(Nanos elapsed) const noexcept RAKS_NONBLOCKING {
    return is_active_ && to_seconds(elapsed) <= kForgotten;
}

Pose Inertialization::apply(const Pose& pose, Nanos elapsed) const noexcept RAKS_NONBLOCKING {
    const double t = to_seconds(elapsed);
    if (!is_active(elapsed)) {
        return pose;
    }
    // Critically damped decay: x(t) = (x0 (1 + y t) + v0 t) exp(-y t).
    const double y = 2.0 * std::log(2.0) / kHalfLife;
    const double decay = std::exp(-y * t);
    const auto a = static_cast<float>(decay * (1.0 + y * t));
    const auto b = static_cast<float>(decay * t);
    Pose result = pose;
    for (std::size_t i = 0; i < rotations_.size(); ++i) {
        const glm::vec3 left = a * rotations_[i].value + b * rotations_[i].speed;
        result.local_rotations[i] = glm::normalize(rotation_of(left) * pose.local_rotations[i]);
    }
    result.hips_position += a * hips_.value + b * hips_.speed;
    return result;
}

}  // namespace raks::motion
