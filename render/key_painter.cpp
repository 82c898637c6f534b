#include "render/key_painter.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace raks::render {
namespace {

/// Samples a pixel: smooth edges where the renderer has them, as far as the driver can.
int samples_of(Quality quality) {
    constexpr GLint kWanted = 4;
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return quality == Quality::high ? std::min(kWanted, most) : 0;
}

}  // namespace

Expected<KeyPainter> KeyPainter::create(Quality quality) {
    const std::array<std::string_view, 1> vertex = {"key.vert"};
    const std::array<std::string_view, 1> fragment = {"key.frag"};
    Expected<gl::Program> program = gl::Program::build({"key colour", vertex, fragment, {}});
    if (!program) {
        return fail(std::move(program.error()));
    }
    return KeyPainter(samples_of(quality), std::move(*program));
}

KeyPainter::KeyPainter(int samples, gl::Program program)
    : samples_(samples), program_(std::move(program)) {}

FrameTarget KeyPainter::canvas(const FrameTarget& target) {
    if (width_ != target.width || height_ != target.height) {
        width_ = target.width;
        height_ = target.height;
        glBindRenderbuffer(GL_RENDERBUFFER, colour_.name());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA8, width_, height_);
        glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
        glRenderbufferStorageMultisample(
            GL_RENDERBUFFER, samples_, GL_DEPTH_COMPONENT24, width_, height_);
        glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
        glFramebufferRenderbuffer(
            GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
        glFramebufferRenderbuffer(
            GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(gl::kPictureUnit));
        glBindTexture(GL_TEXTURE_2D, texture_.name());
        glTexImage2D(
            GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        // One level, read texel by texel.
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glActiveTexture(GL_TEXTURE0);
        glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
        glFramebufferTexture2D(
            GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    }
    FrameTarget canvas{.framebuffer = drawn_.name(), .width = width_, .height = height_};
    if (target.part) {
        canvas.part = target.part;
        canvas.part->x -= target.x;
        canvas.part->y -= target.y;
    }
    return canvas;
}

void KeyPainter::paint(KeyColour key, const FrameTarget& target) noexcept {
    // Averages the samples of each pixel.
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(
        0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    const PixelBox part =
        target.part.value_or(PixelBox{target.x, target.y, target.width, target.height});
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(target.x, target.y, target.width, target.height);
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, part.y, part.width, part.height);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(gl::kPictureUnit));
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glActiveTexture(GL_TEXTURE0);
    program_.use();
    constexpr float kMost = 255.0F;
    glUniform3f(program_.uniform("key"), key[0] / kMost, key[1] / kMost, key[2] / kMost);
    glUniform2i(program_.uniform("corner"), target.x, target.y);
    glUniform1i(program_.uniform("drawn"), gl::kPictureUnit);
    glBindVertexArray(corners_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace raks::render
