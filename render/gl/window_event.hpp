#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/key.hpp"

namespace raks::render {

enum class MouseButton : std::uint8_t { left, right, middle };

/// A button went down or up at (x, y): framebuffer pixels, origin at the top left.
struct MouseButtonEvent {
    MouseButton button{};
    bool is_down = false;
    float x = 0.0F;
    float y = 0.0F;
};

/// The mouse moved by (dx, dy) pixels with `button` held: orbit, pan.
struct MouseDragEvent {
    MouseButton button{};
    bool has_shift = false;
    float dx = 0.0F;
    float dy = 0.0F;
};

/// Steps of the wheel; up and right are positive.
struct ScrollEvent {
    float dx = 0.0F;
    float dy = 0.0F;
};

/// Files were dropped on the window.
struct DropEvent {
    std::vector<std::string> paths;
};

using WindowEvent =
    std::variant<KeyEvent, MouseButtonEvent, MouseDragEvent, ScrollEvent, DropEvent>;

}  // namespace raks::render
