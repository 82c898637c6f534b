#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::render {

/// A grid of small pictures: every pose once for each camera. With 8 poses, cameras {front, side}
/// and 8 columns: the front views in the first row, the side views below.
struct PoseSheetConfig {
    int columns = 8;        ///< poses in a row, >= 1
    int tile_width = 240;   ///< pixels
    int tile_height = 320;  ///< pixels
    int samples = 4;        ///< a pixel
    /// One row of pictures for each, at least one.
    std::vector<Camera> cameras = default_cameras();

    /// "front" and "side", framed for a tile. The target follows the hips over the floor.
    [[nodiscard]] static std::vector<Camera> default_cameras();
};

/// RGBA, top row first.
struct PoseSheet {
    /// Pixels.
    int width = 0;
    /// Pixels.
    int height = 0;
    /// width * height * 4 bytes, rows without gaps.
    std::vector<std::uint8_t> rgba;
};

/// Draws the sheet off-screen in the current context. `scene` gives theme, view and backdrop; its
/// camera is not used. Errors: no pose, no camera, a config value out of range, a sheet that is
/// larger than an OffscreenTarget may be.
/// Threads: the renderer's. Real-time: no.
[[nodiscard]] Expected<PoseSheet> draw_pose_sheet(Renderer& renderer,
                                                  const Scene& scene,
                                                  std::span<const motion::Pose> poses,
                                                  const PoseSheetConfig& config = {});

/// The same of a recorded body's frames.
[[nodiscard]] Expected<PoseSheet> draw_pose_sheet(Renderer& renderer,
                                                  const Scene& scene,
                                                  std::span<const ClipBody> bodies,
                                                  const PoseSheetConfig& config = {});

}  // namespace raks::render
