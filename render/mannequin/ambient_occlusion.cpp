#include "render/mannequin/ambient_occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

constexpr float kAlongNormal = 0.55F;  // strengths of the two kinds of samples
constexpr float kAround = 0.75F;
// Never black: light that bounces off the body itself is not modelled.
constexpr float kDarkest = 0.12F;

/// Share of `reach` by which the surface is nearer than that.
float blocked(const BodyField& field, glm::vec3 p, float reach) noexcept {
    return std::clamp(1.0F - field.distance(p) / reach, 0.0F, 1.0F);
}

/// Five samples along the normal, growing apart: creases.
float blocked_along(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    float sum = 0.0F;
    float weights = 0.0F;
    float weight = 1.0F;
    for (int k = 1; k <= 5; ++k) {
        const auto step = static_cast<float>(k);
        // On open, flat skin the distance at that height is the height itself: nothing is blocked.
        const float height = 0.0066F * step * step + 0.006F;
        // Far samples weigh less.
        weight *= 0.8F;
        sum += weight * blocked(field, p + normal * height, height);
        weights += weight;
    }
    return sum / weights;
}

/// Twelve samples on a cone about the normal: limbs beside one another.
float blocked_around(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    constexpr int kDirections = 6;
    constexpr std::array kHeights = {0.02F, 0.07F};
    // The cone opens 42 degrees from the normal: on flat skin a sample lies at 0.74 of its way over
    // the skin, so a reach a little below that counts no flat skin as blocked.
    constexpr float kReach = 0.72F;
    // Any direction not parallel to the normal will do for the tangents.
    const glm::vec3 other =
        std::abs(normal.y) < 0.9F ? glm::vec3{0.0F, 1.0F, 0.0F} : glm::vec3{1.0F, 0.0F, 0.0F};
    const glm::vec3 t1 = glm::normalize(glm::cross(other, normal));
    const glm::vec3 t2 = glm::cross(normal, t1);
    float sum = 0.0F;
    for (int k = 0; k < kDirections; ++k) {
        const float angle = glm::radians(60.0F * static_cast<float>(k));
        const glm::vec3 direction =
            glm::normalize(normal + 0.9F * (t1 * std::cos(angle) + t2 * std::sin(angle)));
        for (const float height : kHeights) {
            sum += blocked(field, p + direction * height, kReach * height);
        }
    }
    return sum / static_cast<float>(kDirections * kHeights.size());
}

}  // namespace

float ambient_occlusion(const BodyField& field, glm::vec3 p, glm::vec3 normal) noexcept {
    const float open = 1.0F - kAlongNormal * blocked_along(field, p, normal) -
                       kAround * blocked_around(field, p, normal);
    return std::clamp(open, kDarkest, 1.0F);
}

}  // namespace raks::render
