#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"

namespace raks::render {

/// Size of a picture and samples a pixel: 1, or 2 to 4 for anti-aliasing (more than the driver has
/// is lowered to what it has).
struct OffscreenTargetConfig {
    int width = 1280;
    int height = 720;
    int samples = 1;
};

/// A picture in the driver's memory, RGBA with depth, to draw into and read back.
/// Threads: the context's. Real-time: no.
class OffscreenTarget {
 public:
    static constexpr int kMaxSide = 8192;

    /// Errors: a side below 1 or above kMaxSide or what the driver can do; samples outside 1..4.
    [[nodiscard]] static Expected<OffscreenTarget> create(const OffscreenTargetConfig& config);
    OffscreenTarget(OffscreenTarget&&) noexcept;
    OffscreenTarget& operator=(OffscreenTarget&&) noexcept;
    ~OffscreenTarget();

    [[nodiscard]] int width() const noexcept;
    [[nodiscard]] int height() const noexcept;
    /// Samples a pixel that the driver gave.
    [[nodiscard]] int samples() const noexcept;

    /// The whole picture, to draw into.
    [[nodiscard]] FrameTarget frame() const noexcept;

    /// Waits until all that was drawn is in the picture: what a measurement of drawing without
    /// reading back ends with.
    void finish() const noexcept;

    /// Resolves the samples and reads the picture: RGBA, top row first, width * height * 4 bytes.
    /// Errors: as the free read_rgba.
    [[nodiscard]] Expected<void> read_rgba(std::span<std::uint8_t> rgba);

 private:
    struct Parts;
    explicit OffscreenTarget(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
};

}  // namespace raks::render
