#pragma once

#include <span>

#include "base/expected.hpp"
#include "engine/cli/commands.hpp"
#include "engine/picture.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/pose_sheet.hpp"

namespace raks::cli {

/// Draws a pose sheet off-screen and writes it as PNG. Errors: no OpenGL, those of the sheet and of
/// the file.
[[nodiscard]] Expected<void> write_sheet(const Path& output,
                                         const engine::Look& look,
                                         std::span<const motion::Pose> poses,
                                         const render::PoseSheetConfig& config);
[[nodiscard]] Expected<void> write_sheet(const Path& output,
                                         const engine::Look& look,
                                         std::span<const render::ClipFigure> figures,
                                         const render::PoseSheetConfig& config);

}  // namespace raks::cli
