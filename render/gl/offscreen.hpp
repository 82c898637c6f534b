#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"

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

/// Size of a picture and samples a pixel: 1, or 2 to 4 for anti-aliasing (more than the driver has
/// is lowered to what it has).
struct OffscreenTargetConfig {
    /// Pixels, 1 to OffscreenTarget::kMaxSide.
    int width = 1280;
    /// As width.
    int height = 720;
    /// 1 to 4.
    int samples = 1;
};

/// A picture in the driver's memory, RGBA with depth, to draw into and read back.
/// Threads: the context's. Real-time: no.
class OffscreenTarget {
 public:
    /// Largest side, pixels.
    static constexpr int kMaxSide = 8192;

    /// Errors: a side below 1 or above kMaxSide or what the driver can do; samples outside 1..4.
    [[nodiscard]] static Expected<OffscreenTarget> create(const OffscreenTargetConfig& config);
    /// The source may only be destroyed or assigned to.
    OffscreenTarget(OffscreenTarget&&) noexcept;
    /// As the constructor.
    OffscreenTarget& operator=(OffscreenTarget&&) noexcept;
    /// Frees the picture; the context must be current.
    ~OffscreenTarget();

    /// Pixels.
    [[nodiscard]] int width() const noexcept;
    /// Pixels.
    [[nodiscard]] int height() const noexcept;
    /// Samples a pixel that the driver gave.
    [[nodiscard]] int samples() const noexcept;

    /// The whole picture, to draw into.
    [[nodiscard]] FrameTarget frame() const noexcept;

    /// Waits until all that was drawn is in the picture: what a measurement of drawing without
    /// reading back ends with.
    void finish() const noexcept;

    /// Begins to read the picture, so that it is there when others have been drawn meanwhile.
    void begin_reading();
    /// The picture as it was at begin_reading(), the last one: as read_rgba(). Errors: there was
    /// none; `rgba` has another size; the driver refuses.
    [[nodiscard]] Expected<void> finish_reading(std::span<std::uint8_t> rgba);

    /// Copies the picture into a target of its size, such as a window's, as it is now. Drawing goes
    /// on there.
    void copy_to(const FrameTarget& target);

    /// Resolves the samples and reads the picture: RGBA, top row first, width * height * 4 bytes.
    /// Errors: as the free read_rgba.
    [[nodiscard]] Expected<void> read_rgba(std::span<std::uint8_t> rgba);

 private:
    struct Parts;
    explicit OffscreenTarget(std::unique_ptr<Parts> parts) noexcept;
    [[nodiscard]] FrameTarget resolve() noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace raks::render
