#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/key.hpp"

namespace raks::render {

/// The buttons that the window reports.
enum class MouseButton : std::uint8_t { left, right, middle };

/// A button went down or up at (x, y): framebuffer pixels, origin at the top left.
struct MouseButtonEvent {
    /// Which one changed.
    MouseButton button{};
    /// Pressed, or let go.
    bool is_down = false;
    /// From the left edge.
    float x = 0.0F;
    /// From the upper edge.
    float y = 0.0F;
};

/// The mouse moved by (dx, dy) pixels with `button` held: orbit, pan.
struct MouseDragEvent {
    /// The held button; the first of left, right, middle where several are.
    MouseButton button{};
    /// Whether a shift key is down.
    bool has_shift = false;
    /// Pixels to the right.
    float dx = 0.0F;
    /// Pixels downward.
    float dy = 0.0F;
};

/// Steps of the wheel; up and right are positive.
struct ScrollEvent {
    /// Sideways.
    float dx = 0.0F;
    /// Of an ordinary wheel.
    float dy = 0.0F;
};

/// Files were dropped on the window.
struct DropEvent {
    /// As the system gave them.
    std::vector<std::string> paths;
};

using WindowEvent =
    std::variant<KeyEvent, MouseButtonEvent, MouseDragEvent, ScrollEvent, DropEvent>;

}  // namespace raks::render
