#include "engine/show/framing.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raks::engine {
namespace {

// Metres from the mannequin's hips to a hand of a spread arm, and a little air.
constexpr float kReach = 0.80F;
// And to a foot of a long step.
constexpr float kStep = 0.35F;
// Share of the picture's height that is free for them.
constexpr float kFree = 0.94F;
// Seconds in which the camera does two thirds of its way: to where the dancers go, back from them
// (before they leave the picture), and near to them again.
constexpr float kFollowSeconds = 1.6F;
constexpr float kBackSeconds = 0.5F;
constexpr float kNearSeconds = 4.0F;
// Pictures narrower than this see as much from side to side (Camera::clip_from_view).
constexpr float kNarrowestAspect = 0.75F;

// The share of the way that is done in `seconds`.
float share(double seconds, float constant) {
    return 1.0F -
           static_cast<float>(std::exp(-std::max(seconds, 0.0) / static_cast<double>(constant)));
}

glm::vec3 middle_of(std::span<const motion::Pose> poses) {
    glm::vec3 lowest = poses.front().hips_position;
    glm::vec3 highest = lowest;
    for (const motion::Pose& pose : poses) {
        lowest = glm::min(lowest, pose.hips_position);
        highest = glm::max(highest, pose.hips_position);
    }
    return 0.5F * (lowest + highest);
}

// The distance from which every dancer is seen with spread arms, and with the feet.
float distance_to_fit(const render::Camera& camera,
                      std::span<const motion::Pose> poses,
                      float aspect,
                      float size) {
    const float half = std::tan(0.5F * camera.vertical_fov);
    const float wide = half * std::max(aspect, kNarrowestAspect);
    // Half of the height that is seen at 1 m, without the edge of the picture.
    const float high = kFree * half * std::max(1.0F, kNarrowestAspect / aspect);
    const glm::vec3 right(std::cos(camera.yaw), 0.0F, -std::sin(camera.yaw));
    const glm::vec3 toward(std::sin(camera.yaw), 0.0F, std::cos(camera.yaw));
    float distance = 0.0F;
    for (const motion::Pose& pose : poses) {
        const glm::vec3 from_target = pose.hips_position - camera.target;
        const float aside = std::abs(glm::dot(from_target, right)) + kReach * size;
        // Who stands nearer needs more room.
        const float nearer = glm::dot(from_target, toward) * std::cos(camera.pitch);
        distance = std::max(distance, aside / wide + nearer);
        // Feet that step toward the camera leave a picture below.
        glm::vec3 foot = from_target + kStep * size * toward;
        foot.y = -camera.target.y;
        const float below =
            -(foot.y * std::cos(camera.pitch) - glm::dot(foot, toward) * std::sin(camera.pitch));
        const float before =
            glm::dot(foot, toward) * std::cos(camera.pitch) + foot.y * std::sin(camera.pitch);
        distance = std::max(distance, below / high + before);
    }
    return distance;
}

}  // namespace

render::Camera Framing::follow(std::span<const motion::Pose> poses, double seconds) {
    const bool is_first = !camera_;
    render::Camera camera = camera_.value_or(preset_);
    if (poses.empty()) {
        return camera;
    }
    const glm::vec3 middle = middle_of(poses);
    const float moved = is_first ? 1.0F : share(seconds, kFollowSeconds);
    camera.pan_to(camera.target + moved * (middle - camera.target));
    const float wanted = std::max(preset_.distance, distance_to_fit(camera, poses, aspect_, size_));
    const float constant = wanted > camera.distance ? kBackSeconds : kNearSeconds;
    const float stepped = is_first ? 1.0F : share(seconds, constant);
    camera.zoom((camera.distance + stepped * (wanted - camera.distance)) / camera.distance);
    camera_ = camera;
    return camera;
}

}  // namespace raks::engine
