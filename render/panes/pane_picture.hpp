// Pane picture: a picture that panes show.
#pragma once

#include <cstdint>
#include <span>

#include "render/gl/objects.hpp"

namespace raks::render {

/// A picture in the driver's memory, with smaller copies for when it is shown small. Threads: the
/// context's. Real-time: no.
class PanePicture {
 public:
    /// `rgb`: width x height x 3 bytes, top row first; sides >= 1.
    PanePicture(int width, int height, std::span<const std::uint8_t> rgb);
    /// For ImGui.
    [[nodiscard]] std::uint32_t name() const noexcept { return texture_.name(); }

 private:
    gl::Texture texture_;
};

}  // namespace raks::render
