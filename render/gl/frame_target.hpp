#pragma once

#include <cstdint>
#include <span>

#include "base/expected.hpp"

namespace raks::render {

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
};

/// Reads a rectangle back as RGBA, 8 bits each, top row first, rows without gaps. Waits until it is
/// drawn. `framebuffer` must have one sample a pixel (or be the window).
/// Errors: `rgba` is not width * height * 4 bytes long, or the driver refuses.
/// Threads: the context's. Real-time: no.
[[nodiscard]] Expected<void> read_rgba(const FrameTarget& target, std::span<std::uint8_t> rgba);

}  // namespace raks::render
