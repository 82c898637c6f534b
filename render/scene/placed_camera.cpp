#include "render/scene/placed_camera.hpp"

#include <glm/matrix.hpp>

namespace raks::render {
namespace {

// Clip planes, metres, as of the orbit camera.
constexpr double kNearest = 0.1;
constexpr double kFarthest = 60.0;

}  // namespace

PlacedCamera placed_camera(const PinholeView& view) noexcept {
    PlacedCamera placed;
    // From y down, z forward to y up, z backward.
    const glm::dmat3 turned = glm::dmat3(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);
    glm::dmat4 from_world(turned * view.rotation);
    from_world[3] = glm::dvec4(turned * view.translation, 1.0);
    placed.view_from_world = glm::mat4(from_world);
    placed.position = glm::vec3(-(glm::transpose(view.rotation) * view.translation));
    // The picture reaches from -0.5 to width - 0.5.
    glm::dmat4 clip(0.0);
    clip[0][0] = 2.0 * view.fx / view.width;
    clip[1][1] = 2.0 * view.fy / view.height;
    clip[2][0] = 1.0 - (2.0 * view.cx + 1.0) / view.width;
    clip[2][1] = (2.0 * view.cy + 1.0) / view.height - 1.0;
    clip[2][2] = -(kFarthest + kNearest) / (kFarthest - kNearest);
    clip[2][3] = -1.0;
    clip[3][2] = -2.0 * kFarthest * kNearest / (kFarthest - kNearest);
    placed.clip_from_view = glm::mat4(clip);
    return placed;
}

}  // namespace raks::render
