// Clip reading: the door of motion files as commands use it.
#pragma once

#include <filesystem>

#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::apps {

/// The door with models joined to it. `fps`: frames a second where the file is wrong; 0: the
/// file's. `skeleton`: of an .amc; empty: looked for beside it.
[[nodiscard]] motion::MotionReadOptions clip_reading(double fps,
                                                     const std::filesystem::path& skeleton = {});

}  // namespace raks::apps
