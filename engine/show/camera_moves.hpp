#pragma once

#include <cmath>

#include "render/gl/window.hpp"
#include "render/scene/camera.hpp"

/// How mouse and wheel move the camera, alike in every window. Threads: main.
namespace raks::engine {

/// A drag with the left button orbits; with another button, or with Shift, it pans.
inline void move_camera(render::Camera& camera, const render::MouseDragEvent& drag) {
    constexpr float kOrbitPerPixel = 0.008F;  // radians
    constexpr float kPanPerPixel = 0.002F;    // metres
    if (drag.button == render::MouseButton::left && !drag.has_shift) {
        camera.orbit(-drag.dx * kOrbitPerPixel, drag.dy * kOrbitPerPixel);
    } else {
        camera.pan(-drag.dx * kPanPerPixel, drag.dy * kPanPerPixel);
    }
}

/// The wheel zooms: one step is a tenth nearer or further.
inline void move_camera(render::Camera& camera, const render::ScrollEvent& scroll) {
    constexpr float kZoomPerStep = 0.9F;
    camera.zoom(std::pow(kZoomPerStep, scroll.dy));
}

}  // namespace raks::engine
