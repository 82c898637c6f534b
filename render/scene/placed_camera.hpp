#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// A camera that stands where it was measured, in the conventions of computer vision: its own axes
/// are x right, y down, z forward; whole numbers are the middles of pixels, (0, 0) the top left
/// one.
struct PinholeView {
    double width = 640.0;      ///< of the picture, pixels
    double height = 480.0;     ///< likewise
    double fx = 600.0;         ///< focal length, pixels
    double fy = 600.0;         ///< likewise
    double cx = 319.5;         ///< where the line of sight meets the picture, pixels
    double cy = 239.5;         ///< likewise
    glm::dmat3 rotation{1.0};  ///< camera from world
    glm::dvec3 translation{};  ///< camera from world, metres
};

/// The same as OpenGL wants it, for a scene (scene.hpp). Whatever the target's size, the picture
/// shows what PinholeView's would.
struct PlacedCamera {
    glm::mat4 view_from_world{1.0F};  ///< x right, y up, looking along -z
    glm::mat4 clip_from_view{1.0F};
    glm::vec3 position{};  ///< world, metres
};

/// Nearer than 0.1 m and farther than 60 m nothing is drawn. Pure.
[[nodiscard]] PlacedCamera placed_camera(const PinholeView& view) noexcept;

}  // namespace raks::render
