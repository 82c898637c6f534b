#pragma once

#include <optional>
#include <span>

#include "motion/skeleton/pose.hpp"
#include "render/scene/camera.hpp"

namespace raks::engine {

/// Moves a preset's camera so that the dancers stay in the picture, whatever its form: it looks at
/// their middle, and steps back where they would not fit side by side, with spread arms, into a
/// tall or square picture, or where feet that come nearer would leave it below. It follows slowly,
/// as a person behind a camera would. The same poses give the same cameras. Threads: one.
/// Real-time: no.
class Framing {
 public:
    /// `preset`: angle, height and nearest distance. `aspect`: width / height of the picture, > 0.
    /// `size`: of the dancers, against the mannequin's 1.
    Framing(const render::Camera& preset, float aspect, float size = 1.0F)
        : preset_(preset), aspect_(aspect), size_(size) {}

    /// The camera of the next picture, `seconds` (>= 0) after the last one. `poses`: one a dancer,
    /// in world space; none: the camera stays.
    [[nodiscard]] render::Camera follow(std::span<const motion::Pose> poses, double seconds);

 private:
    render::Camera preset_;
    float aspect_;
    float size_;
    std::optional<render::Camera> camera_;  // of the last picture
};

}  // namespace raks::engine
