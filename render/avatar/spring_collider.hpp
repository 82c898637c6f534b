// What swinging joints do not pass: VRMC_springBone 1.0 and VRMC_springBone_extended_collider.
#pragma once

#include <cstddef>

#include "render/model/character.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A collider on a joint. Places in the joint's space, the radius in metres of the world.
struct JointCollider {
    std::size_t joint = 0;
    ColliderShape shape = ColliderShape::sphere;
    glm::vec3 offset{0.0F};
    glm::vec3 tail{0.0F};                ///< capsules: the other end
    glm::vec3 normal{0.0F, 0.0F, 1.0F};  ///< plane: points to where joints may be
    float radius = 0.0F;
};

/// By which way a sphere at `place` leaves the collider.
struct Push {
    glm::vec3 direction{0.0F};  ///< unit
    float distance = 0.0F;      ///< below 0: so deep inside; metres
};

/// How far a sphere of `radius` metres at `place` is from a collider whose joint is at
/// `world_from_joint`; at least 0 where no direction leads out.
/// Threads: any. Real-time: yes.
[[nodiscard]] Push push_of(const JointCollider& collider,
                           const glm::mat4& world_from_joint,
                           const glm::vec3& place,
                           float radius) noexcept;

}  // namespace raks::render
