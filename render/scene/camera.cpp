#include "render/scene/camera.hpp"

#include "base/suggest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/scalar_constants.hpp>
#include <glm/vec4.hpp>
#include <string>

namespace raks::render {
namespace {

// Clip planes, metres: nearer than any permitted distance, farther than the floor's end.
constexpr float kNear = 0.1F;
constexpr float kFar = 60.0F;
constexpr float kNarrowestAspect = 0.75F;

/// The same angle within [-pi, pi).
float wrapped(float angle) noexcept {
    const float turn = 2.0F * glm::pi<float>();
    return angle - turn * std::floor((angle + glm::pi<float>()) / turn);
}

// A named framing: angles in degrees, lengths in metres, over the middle of the floor.
struct Preset {
    std::string_view name;
    float yaw_degrees;
    float pitch_degrees;
    float distance;
    float target_height;
    float fov_degrees;
};

// Framing: far enough that a step toward the camera keeps the feet in the picture.
constexpr std::array<Preset, 6> kPresets = {{
    {"wide", -14.0F, 6.0F, 5.2F, 0.84F, 26.0F},
    {"portrait", -14.0F, 6.0F, 3.8F, 0.86F, 33.0F},
    {"front", 0.0F, 6.0F, 4.3F, 0.86F, 26.0F},
    {"side", 90.0F, 6.0F, 4.3F, 0.86F, 26.0F},
    {"back", 180.0F, 6.0F, 4.3F, 0.86F, 26.0F},
    {"top", 0.0F, 55.0F, 5.6F, 0.5F, 26.0F},
}};

// The names alone, for the command line's help.
constexpr auto kCameraNames = [] {
    std::array<std::string_view, kPresets.size()> names{};
    std::transform(kPresets.begin(), kPresets.end(), names.begin(), [](const Preset& preset) {
        return preset.name;
    });
    return names;
}();

/// The camera of a preset, in radians.
Camera camera_of(const Preset& preset) noexcept {
    Camera camera;
    camera.yaw = wrapped(glm::radians(preset.yaw_degrees));
    camera.pitch = glm::radians(preset.pitch_degrees);
    camera.distance = preset.distance;
    camera.target = {0.0F, preset.target_height, 0.0F};
    camera.vertical_fov = glm::radians(preset.fov_degrees);
    return camera;
}

}  // namespace

void Camera::orbit(float yaw_by, float pitch_by) noexcept {
    if (!std::isfinite(yaw_by) || !std::isfinite(pitch_by)) {
        return;
    }
    yaw = wrapped(yaw + yaw_by);
    pitch = std::clamp(pitch + pitch_by, kMinPitch, kMaxPitch);
}

void Camera::pan(float right, float up) noexcept {
    if (!std::isfinite(right) || !std::isfinite(up)) {
        return;
    }
    // The picture's right hand direction lies in the floor's plane, whatever the pitch is.
    target.x = std::clamp(target.x + right * std::cos(yaw), -kMaxPan, kMaxPan);
    target.z = std::clamp(target.z - right * std::sin(yaw), -kMaxPan, kMaxPan);
    target.y = std::clamp(target.y + up, 0.0F, kMaxTargetHeight);
}

void Camera::pan_to(glm::vec3 place) noexcept {
    if (std::isfinite(place.x) && std::isfinite(place.z)) {
        target.x = std::clamp(place.x, -kMaxPan, kMaxPan);
        target.z = std::clamp(place.z, -kMaxPan, kMaxPan);
    }
}

void Camera::zoom(float factor) noexcept {
    if (std::isfinite(factor) && factor > 0.0F) {
        distance = std::clamp(distance * factor, kMinDistance, kMaxDistance);
    }
}

glm::vec3 Camera::position() const noexcept {
    const float along = distance * std::cos(pitch);
    return target +
           glm::vec3(along * std::sin(yaw), distance * std::sin(pitch), along * std::cos(yaw));
}

glm::mat4 Camera::view_from_world() const noexcept {
    // The pitch stays below 90 degrees, so "up" never coincides with the line of sight.
    const glm::mat4 upright = glm::lookAt(position(), target, glm::vec3(0.0F, 1.0F, 0.0F));
    return roll == 0.0F
               ? upright
               : glm::rotate(glm::mat4(1.0F), -roll, glm::vec3(0.0F, 0.0F, 1.0F)) * upright;
}

glm::mat4 Camera::clip_from_view(float aspect) const noexcept {
    // The horizontal field of view stays what it is at 3:4; the tangent is what scales with the
    // aspect.
    const float narrowing = std::max(1.0F, kNarrowestAspect / aspect);
    const float fov = 2.0F * std::atan(std::tan(0.5F * vertical_fov) * narrowing);
    return glm::perspective(fov, aspect, kNear, kFar);
}

std::span<const std::string_view> camera_names() noexcept { return kCameraNames; }

Expected<Camera> find_camera(std::string_view name) {
    const auto* const found =
        std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& preset) {
            return preset.name == name;
        });
    if (found == kPresets.end()) {
        return fail(unknown_name("camera", name, kCameraNames));
    }
    return camera_of(*found);
}

}  // namespace raks::render
