#pragma once

#include <filesystem>
#include <string>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"

namespace raks::engine {

/// raks-20260131-235959.png, by the clock on the wall, with a number behind it when that is there
/// already: for a file in the folder where the program was started.
[[nodiscard]] std::string screenshot_name();

/// What was drawn to `frame`, as a PNG file. Errors: nothing to read back, the file cannot be
/// written.
[[nodiscard]] Expected<void> write_screenshot(const std::filesystem::path& path,
                                              const render::FrameTarget& frame);

}  // namespace raks::engine
