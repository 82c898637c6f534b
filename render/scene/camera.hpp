#pragma once

#include <span>
#include <string_view>

#include "base/expected.hpp"

#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A camera that orbits a point of the dancer. Angles in radians, lengths in metres; world axes as
/// in motion/skeleton/pose.hpp (y up, the dancer faces +z).
///
/// A value; every method is pure arithmetic and keeps the camera within the limits below, so no
/// series of mouse moves can lose the dancer or turn the floor into a line.
struct Camera {
    static constexpr float kMinPitch = 0.0524F;   ///< 3 degrees: below it the floor is a line
    static constexpr float kMaxPitch = 1.4835F;   ///< 85 degrees: above it "up" has no meaning
    static constexpr float kMinDistance = 0.6F;   ///< a portrait of the head
    static constexpr float kMaxDistance = 38.0F;  ///< the whole floor of a crowd, small
    static constexpr float kMaxPan = 3.0F;        ///< of the target, from the middle of the floor
    /// Of the target, from the floor.
    static constexpr float kMaxTargetHeight = 2.2F;

    float yaw = glm::radians(-14.0F);  ///< 0: from the front; positive: from the dancer's left
    float pitch = glm::radians(6.0F);  ///< above the horizon
    float distance = 5.2F;             ///< from `target`
    /// Point looked at, world space.
    glm::vec3 target{0.0F, 0.84F, 0.0F};
    float roll = 0.0F;  ///< how far it leans to its left; only a camera's motion makes it lean
    /// Field of view from the lower to the upper edge; wider in narrow pictures.
    float vertical_fov = glm::radians(26.0F);

    /// Turns around the target. Yaw wraps into [-pi, pi), pitch stops at its limits.
    void orbit(float yaw_by, float pitch_by) noexcept;

    /// Moves the target in the picture plane, in metres: right, and up along the world's y.
    void pan(float right, float up) noexcept;

    /// Looks at the place over or under `place`, at the target's height.
    void pan_to(glm::vec3 place) noexcept;

    /// Multiplies the distance: 0.9 goes nearer, 1.1 away. Factors <= 0 or NaN do nothing.
    void zoom(float factor) noexcept;

    /// Back to the preset "wide".
    void reset() noexcept { *this = Camera{}; }

    /// Where the camera stands in the world.
    [[nodiscard]] glm::vec3 position() const noexcept;

    /// World space to the camera's: x right, y up, looking along -z.
    [[nodiscard]] glm::mat4 view_from_world() const noexcept;

    /// Perspective for a picture of width / height = `aspect` (> 0). Where a picture is narrower
    /// than 3:4 the field of view grows, so that spread arms stay inside a tall window.
    [[nodiscard]] glm::mat4 clip_from_view(float aspect) const noexcept;

    /// Both in one: world space to OpenGL's clip space.
    [[nodiscard]] glm::mat4 clip_from_world(float aspect) const noexcept {
        return clip_from_view(aspect) * view_from_world();
    }

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Names for --camera: "wide" (the default), "portrait", "front", "side", "back", "top".
[[nodiscard]] std::span<const std::string_view> camera_names() noexcept;

/// The preset of that name. Errors: unknown name, with the nearest known one.
[[nodiscard]] Expected<Camera> find_camera(std::string_view name);

}  // namespace raks::render
