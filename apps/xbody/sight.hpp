// Sight: from the world to places in a box of the frame.
#pragma once

#include <algorithm>
#include <optional>

#include "render/overlay/pen.hpp"
#include "render/scene/camera.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace raks::apps {

/// What a camera sees in a box.
class Sight {
 public:
    Sight(const render::Camera& camera, const render::Box& box)
        : clip_from_world_(camera.clip_from_world(box.width / box.height)),
          upward_(camera.clip_from_view(box.width / box.height)[1][1]),
          box_(box) {}

    /// None: behind the camera.
    [[nodiscard]] std::optional<glm::vec2> place_of(const glm::vec3& point) const {
        const glm::vec4 clip = clip_from_world_ * glm::vec4(point, 1.0F);
        if (!(clip.w > kNearest)) {
            return std::nullopt;
        }
        return glm::vec2(box_.x + box_.width * (0.5F + 0.5F * clip.x / clip.w),
                         box_.y + box_.height * (0.5F - 0.5F * clip.y / clip.w));
    }
    /// Units that a metre at this point takes across the line of sight.
    [[nodiscard]] float units_of_metre(const glm::vec3& point) const {
        const glm::vec4 clip = clip_from_world_ * glm::vec4(point, 1.0F);
        return 0.5F * box_.height * upward_ / std::max(clip.w, kNearest);
    }

 private:
    static constexpr float kNearest = 1e-3F;  // metres

    glm::mat4 clip_from_world_;
    float upward_;
    render::Box box_;
};

}  // namespace raks::apps
