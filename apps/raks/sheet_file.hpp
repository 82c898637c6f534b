#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "engine/show/picture.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/pose_sheet.hpp"

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

/// What is written on a sheet.
struct SheetLabels {
    std::string title;               ///< above all pictures; empty: nothing is written at all
    std::vector<std::string> poses;  ///< one a pose, in its picture; empty: nothing
};
/// The labels of a sheet of figures: numbers on the beats, "&" between them.
[[nodiscard]] SheetLabels figure_labels(std::string title,
                                        std::size_t poses,
                                        int per_beat = kPosesPerBeat);

/// Draws a pose sheet without a window and writes it as PNG: poses of the mannequin, with labels,
/// and the names of the views at the left. Errors: no OpenGL, those of the sheet and of the file.
[[nodiscard]] Expected<void> write_sheet(const Path& output,
                                         const engine::Look& look,
                                         std::span<const motion::Pose> poses,
                                         const render::PoseSheetConfig& config,
                                         const SheetLabels& labels);
/// The same for frames of a recorded clip, as stick figures.
[[nodiscard]] Expected<void> write_sheet(const Path& output,
                                         const engine::Look& look,
                                         std::span<const render::ClipFigure> figures,
                                         const render::PoseSheetConfig& config,
                                         const SheetLabels& labels);

/// Films poses without a window, one a picture: from the front and, beside it, from the side; no
/// sound. `output`: as VideoWriter has it. Errors: no OpenGL, those of the film.
[[nodiscard]] Expected<void> write_film(const Path& output,
                                        const engine::Look& look,
                                        std::span<const motion::Pose> poses,
                                        double fps);

}  // namespace raks::apps
