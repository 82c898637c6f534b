#include "render/gl/offscreen.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "render/gl/objects.hpp"

namespace raks::render {

struct OffscreenContext::Handles {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    std::string renderer_name;

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    ~Handles() {
        if (context != EGL_NO_CONTEXT) {
            // A context that is current would live on until it is released.
            if (eglGetCurrentContext() == context) {
                eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            }
            eglDestroyContext(display, context);
        }
        // The display stays initialized: EGL shares it by platform, and another context of this
        // process may be using it. (eglTerminate would mark all of its contexts for deletion.)
    }
};

namespace {

/// EGL's last error as hexadecimal text: "EGL error 0x3003".
std::string egl_error() {
    const EGLint code = eglGetError();
    constexpr std::array<char, 17> kDigits = {"0123456789ABCDEF"};
    std::string hex = "EGL error 0x";
    for (int shift = 12; shift >= 0; shift -= 4) {
        hex += kDigits[(static_cast<unsigned>(code) >> static_cast<unsigned>(shift)) & 0xFU];
    }
    return hex;
}

/// Mesa's own platform: needs no device node, works with llvmpipe in a container.
EGLDisplay surfaceless_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

/// The first device that EGL names: the way that drivers without Mesa's platform offer.
EGLDisplay device_display() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        return EGL_NO_DISPLAY;
    }
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) != EGL_TRUE || count < 1) {
        return EGL_NO_DISPLAY;
    }
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
}

/// An OpenGL 3.3 core context, or EGL_NO_CONTEXT.
EGLContext core_context(EGLDisplay display) {
    // Any configuration that desktop OpenGL can use: colours and depth are the target's, not EGL's.
    constexpr std::array<EGLint, 5> kConfigWish = {
        EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array<EGLint, 7> kContextWish = {EGL_CONTEXT_MAJOR_VERSION,
                                                    3,
                                                    EGL_CONTEXT_MINOR_VERSION,
                                                    3,
                                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                    EGL_NONE};
    EGLConfig config = nullptr;  // EGL_NO_CONFIG_KHR where none fits: nothing is drawn into it
    EGLint count = 0;
    eglChooseConfig(display, kConfigWish.data(), &config, 1, &count);
    return eglCreateContext(display, config, EGL_NO_CONTEXT, kContextWish.data());
}

// In the order in which they are tried.
struct Platform {
    const char* name;
    EGLDisplay (*display)();
};
constexpr std::array<Platform, 2> kPlatforms = {
    {{"surfaceless", surfaceless_display}, {"device", device_display}}};

/// Initializes the display and makes a context of it current; else says what failed.
Expected<EGLContext> current_context(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY) {
        return fail("not supported");
    }
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        return fail("cannot be initialized, " + egl_error());
    }
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
        return fail("has no desktop OpenGL, " + egl_error());
    }
    const EGLContext context = core_context(display);
    if (context == EGL_NO_CONTEXT) {
        return fail("gives no OpenGL 3.3 core context, " + egl_error());
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
        // Read before the context is destroyed: that call sets the error anew.
        const std::string reason = egl_error();
        eglDestroyContext(display, context);
        return fail("cannot draw without a surface, " + reason);
    }
    return context;
}

/// GL_RENDERER of the current context.
std::string current_renderer_name() {
    const GLubyte* const name = glGetString(GL_RENDERER);
    if (name == nullptr) {
        return "unknown";
    }
    return reinterpret_cast<const char*>(name);  // GL's own type for text
}

}  // namespace

Expected<OffscreenContext> OffscreenContext::create() {
    // epoxy loads libEGL when first asked, and ends the program where it is missing: ask first.
    if (!epoxy_has_egl()) {
        return fail(
            "no way to draw without a window: libEGL.so.1 is missing; on Debian install "
            "libegl1 libegl-mesa0 libgl1-mesa-dri");
    }
    // The same for OpenGL itself; what is loaded here epoxy finds loaded.
    if (::dlopen("libOpenGL.so.0", RTLD_LAZY | RTLD_LOCAL) == nullptr &&
        ::dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL) == nullptr) {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): the C library keeps it for each thread
        return fail(std::string("no way to draw: ") + ::dlerror());
    }
    std::string reasons;
    for (const Platform& platform : kPlatforms) {
        auto handles = std::make_unique<Handles>();
        handles->display = platform.display();
        const Expected<EGLContext> context = current_context(handles->display);
        if (context) {
            handles->context = *context;
            handles->renderer_name = current_renderer_name();
            return OffscreenContext(std::move(handles));
        }
        // The user sees why each platform failed only when none works.
        reasons.append(reasons.empty() ? "" : "; ");
        reasons.append("EGL platform ").append(platform.name).append(": ");
        reasons.append(context.error().message);
    }
    return fail("no way to draw without a window (" + reasons +
                "); on Debian install libegl1 libegl-mesa0 libgl1-mesa-dri");
}

OffscreenContext::OffscreenContext(std::unique_ptr<Handles> handles) noexcept
    : handles_(std::move(handles)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

const std::string& OffscreenContext::renderer_name() const noexcept {
    return handles_->renderer_name;
}

Expected<void> OffscreenContext::make_current() {
    // The bound API belongs to the thread, so another thread must bind it, too.
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
        eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context) !=
            EGL_TRUE) {
        return fail("the off-screen context cannot be made current, " + egl_error());
    }
    return {};
}

namespace {

/// A framebuffer with colour and depth of `samples` a pixel (0: no multisampling).
struct Attachments {
    gl::Framebuffer framebuffer;
    gl::Renderbuffer colour;
    gl::Renderbuffer depth;

    [[nodiscard]] Expected<void> allocate(const OffscreenTargetConfig& config, GLsizei samples);
};

/// Attaches storage of the wanted size; the driver's refusal becomes an error, not a black picture.
Expected<void> Attachments::allocate(const OffscreenTargetConfig& config, GLsizei samples) {
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
    Attachments drawn;
    std::optional<Attachments> resolved;  // with multisampling: what is read
    std::optional<gl::Buffer> reading;    // of begin_reading()
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

/// Where each pixel is one sample.
FrameTarget OffscreenTarget::resolve() noexcept {
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
    return readable;
}

Expected<void> OffscreenTarget::read_rgba(std::span<std::uint8_t> rgba) {
    return render::read_rgba(resolve(), rgba);
}

/// The driver copies into a buffer of its own when it comes to it.
void OffscreenTarget::begin_reading() {
    const FrameTarget readable = resolve();
    if (!parts_->reading) {
        parts_->reading.emplace();
        glBindBuffer(GL_PIXEL_PACK_BUFFER, parts_->reading->name());
        const auto bytes = static_cast<GLsizeiptr>(width()) * height() * 4;
        glBufferData(GL_PIXEL_PACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, parts_->reading->name());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, readable.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width(), height(), GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void OffscreenTarget::copy_to(const FrameTarget& target) {
    const FrameTarget from = resolve();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glBlitFramebuffer(0,
                      0,
                      width(),
                      height(),
                      target.x,
                      target.y,
                      target.x + width(),
                      target.y + height(),
                      GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
}

Expected<void> OffscreenTarget::finish_reading(std::span<std::uint8_t> rgba) {
    const std::size_t row = static_cast<std::size_t>(width()) * 4;
    const auto rows = static_cast<std::size_t>(height());
    if (!parts_->reading || rgba.size() != row * rows) {
        return fail("a picture of " + std::to_string(width()) + "x" + std::to_string(height()) +
                    " was not read, or does not have " + std::to_string(rgba.size()) + " bytes");
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, parts_->reading->name());
    const auto* const from = static_cast<const std::uint8_t*>(glMapBufferRange(
        GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(row * rows), GL_MAP_READ_BIT));
    if (from != nullptr) {
        // OpenGL has the lowest row first.
        for (std::size_t y = 0; y < rows; ++y) {
            std::copy_n(from + (rows - 1 - y) * row, row, &rgba[y * row]);
        }
        glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    return from != nullptr ? Expected<void>() : fail("the driver does not give the picture back");
}

}  // namespace raks::render
