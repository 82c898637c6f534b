#pragma once

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/objects.hpp"
#include "render/gl/shader_program.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::render {

/// Lays a picture with alpha over a key colour so that none of the colour is mixed into it: a pixel
/// that the picture covers by half or more is the picture's own colour, any other is the key.
///
///     const FrameTarget canvas = painter.canvas(target);
///     ... draw the picture into the canvas, alpha 0 where nothing is
///     painter.paint(key, target);
///
/// Threads: the context's.
class KeyPainter {
 public:
    /// `quality` is fast or high. Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<KeyPainter> create(Quality quality);

    /// Where to draw the picture that belongs to `target`: as large, and with alpha, which a
    /// window's own framebuffer may lack. Valid until the next call.
    [[nodiscard]] FrameTarget canvas(const FrameTarget& target);

    /// The picture of the canvas over `key`, into the target that canvas() was called for.
    void paint(KeyColour key, const FrameTarget& target) noexcept;

 private:
    KeyPainter(int samples, gl::Program program);

    int samples_;
    int width_ = 0;  // of the canvas; 0: there is none yet
    int height_ = 0;
    gl::Program program_;
    gl::VertexArray corners_;  // without attributes: the shader makes them of their numbers
    gl::Framebuffer drawn_;
    gl::Renderbuffer colour_;
    gl::Renderbuffer depth_;
    gl::Framebuffer resolved_;
    gl::Texture texture_;
};

}  // namespace raks::render
