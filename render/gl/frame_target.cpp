#include "render/gl/frame_target.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace raks::render {
namespace {

/// OpenGL's rows go up, a picture's go down.
void flip_rows(std::span<std::uint8_t> rgba, std::size_t row_bytes) {
    const std::size_t rows = rgba.size() / row_bytes;
    for (std::size_t top = 0; top < rows / 2; ++top) {
        const auto upper = rgba.subspan(top * row_bytes, row_bytes);
        const auto lower = rgba.subspan((rows - 1 - top) * row_bytes, row_bytes);
        std::swap_ranges(upper.begin(), upper.end(), lower.begin());
    }
}

}  // namespace

Expected<void> read_rgba(const FrameTarget& target, std::span<std::uint8_t> rgba) {
    if (target.width < 1 || target.height < 1) {
        return fail("a picture without area cannot be read back");
    }
    const std::size_t row_bytes = static_cast<std::size_t>(target.width) * 4U;
    const std::size_t needed = row_bytes * static_cast<std::size_t>(target.height);
    if (rgba.size() != needed) {
        return fail("reading back a picture needs " + std::to_string(needed) + " bytes, got " +
                    std::to_string(rgba.size()));
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer);
    // A pixel buffer or row length that other code left set would redirect or spread the bytes.
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glReadPixels(
        target.x, target.y, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    // glReadPixels reports a multisampled or incomplete framebuffer in this way alone.
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        return fail("the driver refuses to read the picture back (OpenGL error " +
                    std::to_string(error) + ")");
    }
    flip_rows(rgba, row_bytes);
    return {};
}

}  // namespace raks::render
