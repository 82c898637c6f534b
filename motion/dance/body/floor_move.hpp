// Floor moves: rigid moves of a dancer on the floor.
#pragma once

#include <cmath>

#include "motion/skeleton/pose.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// Rotation about the upright axis, positive from +z to +x; radians. Threads: any. Real-time: yes.
[[nodiscard]] inline glm::quat turn_about_up(float radians) noexcept {
    return {std::cos(0.5F * radians), 0.0F, std::sin(0.5F * radians), 0.0F};
}

/// A rigid move on the floor: turn by `heading` about the origin (positive from +z to +x), then
/// shift by `offset` (x left, y forward: the floor's x and z). Threads: any. Real-time: yes.
struct FloorMove {
    double heading = 0.0;         ///< radians
    glm::dvec2 offset{0.0, 0.0};  ///< metres

    /// Turns a vector by the heading.
    [[nodiscard]] glm::dvec2 turned(const glm::dvec2& place) const noexcept {
        const double c = std::cos(heading);
        const double s = std::sin(heading);
        return {c * place.x + s * place.y, c * place.y - s * place.x};
    }
    /// Moves a place.
    [[nodiscard]] glm::dvec2 operator()(const glm::dvec2& place) const noexcept {
        return turned(place) + offset;
    }
    /// Moves a pose by its hips.
    [[nodiscard]] Pose operator()(Pose pose) const noexcept {
        const glm::dvec2 place = (*this)(glm::dvec2(pose.hips_position.x, pose.hips_position.z));
        pose.hips_position.x = static_cast<float>(place.x);
        pose.hips_position.z = static_cast<float>(place.y);
        pose.rotation(Bone::hips) =
            turn_about_up(static_cast<float>(heading)) * pose.rotation(Bone::hips);
        return pose;
    }
};

/// Composition: applies `second`, then `first`.
[[nodiscard]] inline FloorMove operator*(const FloorMove& first, const FloorMove& second) noexcept {
    return {first.heading + second.heading, first(second.offset)};
}

/// Where a pose stands: its hips on the floor, and which way they face.
[[nodiscard]] inline FloorMove floor_frame(const Pose& pose) noexcept {
    const glm::vec3 ahead = pose.rotation(Bone::hips) * glm::vec3(0.0F, 0.0F, 1.0F);
    return {std::atan2(static_cast<double>(ahead.x), static_cast<double>(ahead.z)),
            {pose.hips_position.x, pose.hips_position.z}};
}

/// The move that undoes `move`.
[[nodiscard]] inline FloorMove inverse(const FloorMove& move) noexcept {
    FloorMove result{-move.heading, {}};
    result.offset = -result.turned(move.offset);
    return result;
}

}  // namespace raks::motion
