#include "render/gl/offscreen_target.hpp"

#include "render/gl/objects.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace raks::render {
namespace {

/// A framebuffer with colour and depth of `samples` a pixel (0: no multisampling).
struct Surface {
    gl::Framebuffer framebuffer;
    gl::Renderbuffer colour;
    gl::Renderbuffer depth;

    [[nodiscard]] Expected<void> allocate(const OffscreenTargetConfig& config, GLsizei samples);
};

/// Attaches storage of the wanted size; the driver's refusal becomes an error, not a black picture.
Expected<void> Surface::allocate(const OffscreenTargetConfig& config, GLsizei samples) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glBindRenderbuffer(GL_RENDERBUFFER, colour.name());
    glRenderbufferStorageMultisample(
        GL_RENDERBUFFER, samples, GL_RGBA8, config.width, config.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
    glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
    // Colour and depth of one framebuffer need the same number of samples.
    glRenderbufferStorageMultisample(
        GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, config.width, config.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    const GLenum error = glGetError();
    if (status != GL_FRAMEBUFFER_COMPLETE || error != GL_NO_ERROR) {
        return fail("the driver refuses a picture of " + std::to_string(config.width) + "x" +
                    std::to_string(config.height) + " (OpenGL status " + std::to_string(status) +
                    ", error " + std::to_string(error) + "); use a smaller size");
    }
    return {};
}

/// Checks the size against the driver's limit as well as ours.
Expected<void> validate(const OffscreenTargetConfig& config) {
    GLint driver_limit = OffscreenTarget::kMaxSide;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &driver_limit);
    const int limit = std::min(driver_limit, OffscreenTarget::kMaxSide);
    if (config.width < 1 || config.height < 1 || config.width > limit || config.height > limit) {
        return fail("picture size " + std::to_string(config.width) + "x" +
                    std::to_string(config.height) + " is out of range, each side must be 1 to " +
                    std::to_string(limit));
    }
    if (config.samples < 1 || config.samples > 4) {
        return fail("samples a pixel are " + std::to_string(config.samples) + ", must be 1 to 4");
    }
    return {};
}

}  // namespace

struct OffscreenTarget::Parts {
    OffscreenTargetConfig config;
    Surface drawn;
    std::optional<Surface> resolved;  // with multisampling: what is read
};

Expected<OffscreenTarget> OffscreenTarget::create(const OffscreenTargetConfig& config) {
    if (Expected<void> valid = validate(config); !valid) {
        return fail(std::move(valid.error()));
    }
    GLint most_samples = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
    auto parts = std::make_unique<Parts>();
    parts->config = config;
    // Fewer samples than asked for are better than no picture.
    parts->config.samples = std::max(1, std::min(config.samples, most_samples));
    const bool is_multisampled = parts->config.samples > 1;
    Expected<void> made =
        parts->drawn.allocate(config, is_multisampled ? parts->config.samples : 0);
    if (made && is_multisampled) {
        // A multisampled picture cannot be read: it is resolved into a plain one first.
        made = parts->resolved.emplace().allocate(config, 0);
    }
    if (!made) {
        return fail(std::move(made.error()));
    }
    return OffscreenTarget(std::move(parts));
}

OffscreenTarget::OffscreenTarget(std::unique_ptr<Parts> parts) noexcept
    : parts_(std::move(parts)) {}
OffscreenTarget::OffscreenTarget(OffscreenTarget&&) noexcept = default;
OffscreenTarget& OffscreenTarget::operator=(OffscreenTarget&&) noexcept = default;
OffscreenTarget::~OffscreenTarget() = default;

int OffscreenTarget::width() const noexcept { return parts_->config.width; }
int OffscreenTarget::height() const noexcept { return parts_->config.height; }
int OffscreenTarget::samples() const noexcept { return parts_->config.samples; }

/// Drawing always goes into the multisampled framebuffer, where there is one.
FrameTarget OffscreenTarget::frame() const noexcept {
    return {.framebuffer = parts_->drawn.framebuffer.name(), .width = width(), .height = height()};
}

void OffscreenTarget::finish() const noexcept { glFinish(); }

Expected<void> OffscreenTarget::read_rgba(std::span<std::uint8_t> rgba) {
    FrameTarget readable = frame();
    // Averages the samples of each pixel.
    if (parts_->resolved) {
        const GLuint resolved = parts_->resolved->framebuffer.name();
        glBindFramebuffer(GL_READ_FRAMEBUFFER, readable.framebuffer);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved);
        glBlitFramebuffer(
            0, 0, width(), height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT, GL_NEAREST);
        readable.framebuffer = resolved;
    }
    return render::read_rgba(readable, rgba);
}

}  // namespace raks::render
