#include "motion/capture/keypoints/pose_square.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::capture {

glm::dvec2 PoseSquare::to_picture(const glm::dvec2& place) const noexcept {
    const glm::dvec2 offset = (place - 0.5) * side;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return centre + glm::dvec2(c * offset.x - s * offset.y, s * offset.x + c * offset.y);
}

glm::dvec2 PoseSquare::from_picture(const glm::dvec2& pixel) const noexcept {
    const glm::dvec2 offset = (pixel - centre) / side;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return glm::dvec2(c * offset.x + s * offset.y, c * offset.y - s * offset.x) + 0.5;
}

PoseSquare pose_square(const glm::dvec2& hips, const glm::dvec2& on_circle) noexcept {
    constexpr double kRadii = 2.5;  // 2 for the circle, a quarter more about it
    const glm::dvec2 up = on_circle - hips;
    return {hips, kRadii * glm::length(up), std::atan2(up.x, -up.y)};
}

double overlap_of(const PoseSquare& one, const PoseSquare& other) noexcept {
    double common = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double low =
            std::max(one.centre[axis] - one.side / 2, other.centre[axis] - other.side / 2);
        const double high =
            std::min(one.centre[axis] + one.side / 2, other.centre[axis] + other.side / 2);
        common *= std::max(0.0, high - low);
    }
    const double all = one.side * one.side + other.side * other.side - common;
    return all > 0.0 ? common / all : 0.0;
}

}  // namespace raks::capture
