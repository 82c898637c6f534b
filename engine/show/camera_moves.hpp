#pragma once

#include <cmath>

#include "render/gl/window_event.hpp"
#include "render/scene/camera.hpp"

/// What mouse and wheel do to the camera, in every window.
namespace raks::engine {

inline void move_camera(render::Camera& camera, const render::MouseDragEvent& drag) {
    constexpr float kOrbitPerPixel = 0.008F;  // radians
    constexpr float kPanPerPixel = 0.002F;    // metres
    if (drag.button == render::MouseButton::left && !drag.has_shift) {
        camera.orbit(-drag.dx * kOrbitPerPixel, drag.dy * kOrbitPerPixel);
    } else {
        camera.pan(-drag.dx * kPanPerPixel, drag.dy * kPanPerPixel);
    }
}

inline void move_camera(render::Camera& camera, const render::ScrollEvent& scroll) {
    constexpr float kZoomPerStep = 0.9F;
    camera.zoom(std::pow(kZoomPerStep, scroll.dy));
}

}  // namespace raks::engine
