#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/expected.hpp"

namespace raks::render {

/// A part of a framebuffer: left and lower edge, width and height, pixels.
struct PixelBox {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Where to draw: a rectangle of a framebuffer object of the current context. 0 is the window.
/// The origin is the lower left corner, in pixels.
struct FrameTarget {
    /// OpenGL name; 0 is the window's own.
    std::uint32_t framebuffer = 0;
    /// Left edge.
    int x = 0;
    /// Lower edge.
    int y = 0;
    /// Below 1: nothing is drawn.
    int width = 0;
    /// As width.
    int height = 0;
    /// Of the framebuffer, within the rectangle: nothing else is drawn or cleared, and what is
    /// drawn is as in the whole picture. None: all of the rectangle.
    std::optional<PixelBox> part{};
};

/// Reads a rectangle back as RGBA, 8 bits each, top row first, rows without gaps. Waits until it is
/// drawn. `framebuffer` must have one sample a pixel (or be the window).
/// Errors: `rgba` is not width * height * 4 bytes long, or the driver refuses.
/// Threads: the context's. Real-time: no.
[[nodiscard]] Expected<void> read_rgba(const FrameTarget& target, std::span<std::uint8_t> rgba);

}  // namespace raks::render
