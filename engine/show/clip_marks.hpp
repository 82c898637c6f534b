// Clip marks: names and trails of a recording's points, over the picture.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/gl/frame_target.hpp"
#include "render/overlay/overlay.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/clip_body.hpp"

namespace raks::engine {

/// What the colour of a part of the bodies means.
struct MarkKey {
    std::string name;  ///< "captured.bvh"
    render::StickPart part = render::StickPart::middle;
};

/// Which marks are drawn.
struct ShownMarks {
    bool has_names = false;       ///< of points or joints
    bool has_trails = false;      ///< where they were in the last second
    std::vector<MarkKey> keys{};  ///< upper left, one below the other
};

/// Computes where names and trails of a recording lie in a picture. Threads: one. Real-time: no.
class ClipMarks {
 public:
    /// The marks of a frame. `frames_per_second`: of the recording, which gives the trails their
    /// length; `camera`: the picture's. What lies behind the camera is left out, and of very many
    /// points the trails have fewer places.
    void place(const render::RecordedBodies& recorded,
               std::size_t frame,
               double frames_per_second,
               const ShownMarks& shown,
               const render::Camera& camera,
               const render::FrameTarget& target);

    /// Those of the last frame placed; they live until the next, names as long as bodies and keys.
    [[nodiscard]] std::span<const render::OverlayLine> lines() const noexcept { return lines_; }
    [[nodiscard]] std::span<const render::OverlayLabel> labels() const noexcept {  ///< likewise
        return labels_;
    }

 private:
    void place_keys(const std::vector<MarkKey>& keys, const render::FrameTarget& target);

    std::vector<render::OverlayLine> lines_;
    std::vector<render::OverlayLabel> labels_;
};

}  // namespace raks::engine
