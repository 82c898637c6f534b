#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "engine/show/picture.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/gl/offscreen.hpp"
#include "render/pose_sheet.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::apps {

/// Poses a beat on a sheet: every eighth.
constexpr int kPosesPerBeat = 8;
/// The layout of a sheet of figures: two beats in eighths a row.
[[nodiscard]] inline render::PoseSheetConfig figure_sheet() {
    render::PoseSheetConfig config;
    config.columns = 2 * kPosesPerBeat;
    config.tile_width = 120;
    config.tile_height = 180;
    return config;
}

/// Of sheets and films that are not in a hurry: shadows and smooth edges, unless somebody wants it
/// fast.
[[nodiscard]] inline render::Quality best_quality(const engine::Look& look) {
    return look.quality == render::Quality::fast ? look.quality : render::Quality::high;
}

/// What is written on a sheet.
struct SheetLabels {
    std::string title;               ///< above all pictures; empty: nothing is written at all
    std::vector<std::string> poses;  ///< one a pose, in its picture; empty: nothing
};
/// The labels of a sheet of figures: numbers on the beats, "&" between them.
[[nodiscard]] SheetLabels figure_labels(std::string title,
                                        std::size_t poses,
                                        int per_beat = kPosesPerBeat);

/// What draws sheets and films without a window. To open it takes some tenths of a second: one
/// serves all that a command draws. Threads: one.
class SheetStudio {
 public:
    /// `quality`: of the drawing, in place of the look's. Errors: no OpenGL, or the driver refuses.
    [[nodiscard]] static Expected<SheetStudio> open(const engine::Look& look,
                                                    render::Quality quality);

    /// Draws a pose sheet and writes it as PNG: poses of the mannequin, with labels, and the names
    /// of the views at the left. Errors: those of the sheet and of the file.
    [[nodiscard]] Expected<void> write_sheet(const Path& output,
                                             std::span<const motion::Pose> poses,
                                             const render::PoseSheetConfig& config,
                                             const SheetLabels& labels);
    /// The same for frames of a recorded clip, as stick figures.
    [[nodiscard]] Expected<void> write_sheet(const Path& output,
                                             std::span<const render::ClipBody> bodies,
                                             const render::PoseSheetConfig& config,
                                             const SheetLabels& labels);
    /// Draws a pose sheet for whoever writes around it. Errors: those of the sheet.
    [[nodiscard]] Expected<render::PoseSheet> draw_sheet(std::span<const motion::Pose> poses,
                                                         const render::PoseSheetConfig& config);
    /// The same of stick figures, whatever the look says.
    [[nodiscard]] Expected<render::PoseSheet> draw_sticks(std::span<const motion::Pose> poses,
                                                          const render::PoseSheetConfig& config);
    /// Films poses, one a picture: from the front and, beside it, from the side; no sound.
    /// `output`: as VideoWriter has it. Errors: those of the film.
    [[nodiscard]] Expected<void> write_film(const Path& output,
                                            std::span<const motion::Pose> poses,
                                            double fps);

 private:
    SheetStudio(render::OffscreenContext context,
                render::Renderer renderer,
                const engine::Look& look,
                render::Quality quality);
    [[nodiscard]] render::PoseSheetConfig framed(render::PoseSheetConfig config) const;
    template <typename Body>
    [[nodiscard]] Expected<void> write(const Path& output,
                                       std::span<const Body> bodies,
                                       const render::PoseSheetConfig& config,
                                       const SheetLabels& labels);

    render::OffscreenContext context_;
    render::Renderer renderer_;  // destroyed before the context, which it needs
    render::Scene scene_;
    float size_;               // of who is drawn, against the mannequin
    render::Quality quality_;  // as it was asked for
};

}  // namespace raks::apps
