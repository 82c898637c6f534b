#pragma once

#include <array>

#include "motion/skeleton/skeleton.hpp"
#include "render/scene/camera.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Unit directions toward the three lights, world space. They turn with the camera (the key light
/// by 0.6 of its yaw, the others fully), so that every side of the dancer is well lit.
struct LightDirections {
    /// The main light, from the front left of the picture and above; casts the shadow.
    glm::vec3 key{};
    /// From the right, low: lifts the key light's dark side.
    glm::vec3 fill{};
    /// From behind: draws a bright edge.
    glm::vec3 rim{};
};
/// The directions for a camera's yaw. Pure.
[[nodiscard]] LightDirections light_directions(const Camera& camera) noexcept;

/// A soft round shadow on the floor: light times 1 - strength * exp(-d^2 / radius^2).
struct ShadowBlob {
    /// Of the middle, world space, metres.
    float x = 0.0F;
    /// As x.
    float z = 0.0F;
    float radius = 0.0F;    ///< metres
    float strength = 0.0F;  ///< [0, 1]
};
/// Blobs of one dancer.
inline constexpr std::size_t kShadowBlobs = 11;

/// Blobs of the large joints, projected on the floor along the key light; wider and weaker with
/// height. What the fast shaders have for a shadow. `scale`: the dancer's size, the mannequin's
/// is 1.
[[nodiscard]] std::array<ShadowBlob, kShadowBlobs> shadow_blobs(const motion::WorldPose& world,
                                                                float scale,
                                                                glm::vec3 key) noexcept;

/// Orthographic view from the key light around the dancers, 1.25 m and `spread` (how far the hips
/// of the outermost are from the middle of all) to each side, to clip space.
[[nodiscard]] glm::mat4 light_clip_from_world(glm::vec3 hips, float spread, glm::vec3 key) noexcept;

}  // namespace raks::render
