#pragma once

#include <memory>
#include <string>

#include "base/expected.hpp"

namespace raks::render {

/// An OpenGL 3.3 core context without window, display server or surface. It is current on the
/// thread that created it; draw into an OffscreenTarget.
///
///     auto context = OffscreenContext::create();
///     auto renderer = Renderer::create(avatar);
///     auto target = OffscreenTarget::create({.width = 1280, .height = 720});
///     renderer->draw(scene, pose, target->frame());
///
/// Must outlive what is made in it. Threads: one at a time. Real-time: no.
class OffscreenContext {
 public:
    /// Tries EGL's surfaceless platform, then its device platform. Errors: neither works; the line
    /// says what each of them answered and which package is missing.
    [[nodiscard]] static Expected<OffscreenContext> create();
    /// Moving leaves the context current; the source may only be destroyed or assigned to.
    OffscreenContext(OffscreenContext&&) noexcept;
    /// As the constructor.
    OffscreenContext& operator=(OffscreenContext&&) noexcept;
    /// Destroys the context, which must not be current on another thread.
    ~OffscreenContext();

    /// Name of the driver's renderer: "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] const std::string& renderer_name() const noexcept;

    /// Makes it the current context of this thread.
    [[nodiscard]] Expected<void> make_current();

 private:
    struct Handles;
    explicit OffscreenContext(std::unique_ptr<Handles> handles) noexcept;
    std::unique_ptr<Handles> handles_;
};

}  // namespace raks::render
