#include "render/avatar/spring_collider.hpp"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

glm::vec3 world_point(const glm::mat4& matrix, const glm::vec3& point) noexcept {
    return glm::vec3(matrix * glm::vec4(point, 1.0F));
}

// The point of the collider's core (its middle, or the line between a capsule's ends) that is
// nearest to `place`.
glm::vec3 core_point(const JointCollider& collider,
                     const glm::mat4& matrix,
                     const glm::vec3& place) noexcept {
    const glm::vec3 head = world_point(matrix, collider.offset);
    if (collider.shape != ColliderShape::capsule &&
        collider.shape != ColliderShape::inside_capsule) {
        return head;
    }
    const glm::vec3 along = world_point(matrix, collider.tail) - head;
    const float square = glm::dot(along, along);
    if (!(square > 0.0F)) {
        return head;
    }
    return head + along * std::clamp(glm::dot(place - head, along) / square, 0.0F, 1.0F);
}

Push plane_push(const JointCollider& collider,
                const glm::mat4& matrix,
                const glm::vec3& place,
                float radius) noexcept {
    // Normals turn as the planes do, also under uneven scales.
    const glm::vec3 normal = glm::inverse(glm::transpose(glm::mat3(matrix))) * collider.normal;
    const float length = glm::length(normal);
    if (!(length > 0.0F)) {
        return {};
    }
    const glm::vec3 unit = normal / length;
    return {.direction = unit,
            .distance = glm::dot(place - world_point(matrix, collider.offset), unit) - radius};
}

}  // namespace

Push push_of(const JointCollider& collider,
             const glm::mat4& world_from_joint,
             const glm::vec3& place,
             float radius) noexcept {
    if (collider.shape == ColliderShape::plane) {
        return plane_push(collider, world_from_joint, place, radius);
    }
    const glm::vec3 away = place - core_point(collider, world_from_joint, place);
    const float distance = glm::length(away);
    if (!(distance > 0.0F)) {
        return {};
    }
    const bool is_inside = collider.shape == ColliderShape::inside_sphere ||
                           collider.shape == ColliderShape::inside_capsule;
    if (is_inside) {
        return {.direction = -away / distance, .distance = collider.radius - radius - distance};
    }
    return {.direction = away / distance, .distance = distance - radius - collider.radius};
}

}  // namespace raks::render
