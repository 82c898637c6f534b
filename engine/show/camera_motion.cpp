#include "engine/show/camera_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/file.hpp"
#include "motion/skeleton/formats/mmd/mmd_body.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {

Expected<CameraMotion> CameraMotion::load(const std::filesystem::path& file) {
    const auto bytes = read_file(file);
    if (!bytes) {
        return fail(bytes.error());
    }
    auto path = motion::MmdCameraPath::parse(*bytes, file.string());
    if (!path) {
        return fail(std::move(path.error()));
    }
    return CameraMotion(std::move(*path));
}

render::Camera CameraMotion::at(double seconds, float size) const {
    // It frames the heads of bodies that are less tall than the mannequin.
    constexpr double kMannequinHeight = 1.73;  // metres
    return camera_of(path_.at(seconds),
                     size * static_cast<float>(kMannequinHeight / motion::kMmdHeight));
}

render::Camera camera_of(const motion::MmdView& view, float size) {
    constexpr double kLeastDistance = 0.5;  // metres, of what is looked at
    constexpr double kMostPitch = 89.9;     // degrees: straight up, "up" has no meaning
    const double scale = static_cast<double>(size);
    const glm::dvec3 eye = scale * view.eye();
    const glm::dvec3 back = view.turn * glm::dvec3(0.0, 0.0, 1.0);
    render::Camera camera;
    camera.yaw = static_cast<float>(std::atan2(back.x, back.z));
    camera.pitch = static_cast<float>(std::clamp(std::asin(std::clamp(back.y, -1.0, 1.0)),
                                                 glm::radians(-kMostPitch),
                                                 glm::radians(kMostPitch)));
    // A camera before its target looks away from it: then what it sees counts.
    const double distance = std::max(scale * view.distance, kLeastDistance);
    camera.distance = static_cast<float>(distance);
    camera.target = glm::vec3(eye - distance * back);
    // How the camera leans against one that stands upright.
    const glm::dvec3 right(std::cos(camera.yaw), 0.0, -std::sin(camera.yaw));
    const glm::dvec3 up = glm::cross(back, right);
    const glm::dvec3 own_right = view.turn * glm::dvec3(1.0, 0.0, 0.0);
    camera.roll =
        static_cast<float>(std::atan2(glm::dot(own_right, up), glm::dot(own_right, right)));
    camera.vertical_fov = static_cast<float>(glm::radians(std::clamp(view.view_angle, 1.0, 150.0)));
    return camera;
}

}  // namespace raks::engine
