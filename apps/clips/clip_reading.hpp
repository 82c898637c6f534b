// Clip reading: the door of motion files as commands use it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/clips/joint_options.hpp"
#include "base/expected.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::apps {

/// The door with models joined to it. `fps`: frames a second where the file is wrong; 0: the
/// file's. `skeleton`: of an .amc; empty: looked for beside it. `arm_angle`: of a motion of
/// MikuMikuDance, degrees; none: the usual one.
[[nodiscard]] motion::MotionReadOptions clip_reading(double fps,
                                                     const std::filesystem::path& skeleton = {},
                                                     std::optional<double> arm_angle = {});

/// Whether files that options name can be opened and the joints be read, also where the command
/// will have no use for them. Paths may be empty: none. Errors: the first that cannot; those of
/// JointArguments::labels.
[[nodiscard]] Expected<void> check_clip_options(const JointArguments& joints,
                                                const std::vector<std::filesystem::path>& files);

}  // namespace raks::apps
