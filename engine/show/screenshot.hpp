#pragma once

#include <filesystem>
#include <string>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"

namespace raks::engine {

/// A file name from the local time, "raks-20260131-235959.png"; with a number appended when a file
/// of that name exists in the current folder.
[[nodiscard]] std::string screenshot_name();

/// Writes what was drawn to `frame` as a PNG file. An OpenGL context must be current. Errors: the
/// frame cannot be read back, the file cannot be written.
[[nodiscard]] Expected<void> write_screenshot(const std::filesystem::path& path,
                                              const render::FrameTarget& frame);

}  // namespace raks::engine
