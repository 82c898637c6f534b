// Filmed motion: a dance of a file as the test studio's dancer dances it.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::apps {

/// A motion on the mannequin.
struct FilmedMotion {
    std::vector<motion::Pose> poses;
    double frames_per_second = 0.0;
};

/// What of a file is danced, and how.
struct FilmedMotionOptions {
    double frames_per_second = 0.0;     ///< of the file, where it is wrong; 0: the file's
    double tempo = 1.0;                 ///< so many times as fast
    double seconds = 0.0;               ///< from its begin; 0: all
    motion::BodyOptions body;           ///< how the body lies in the file
    std::optional<double> arm_angle{};  ///< of a VMD: motion::MotionReadOptions
};

/// Reads a motion file of any form and puts it on the mannequin. A jump out of a T-pose within the
/// first half second, which no dancer makes, is replaced by the pose behind it. Errors: those of
/// the file, a body that is not found in it.
[[nodiscard]] Expected<FilmedMotion> read_filmed_motion(const std::filesystem::path& file,
                                                        const FilmedMotionOptions& options);

}  // namespace raks::apps
