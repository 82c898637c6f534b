#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/joint_labels.hpp"
#include "training/figures/figure_trainer.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// Units that a motion file may lack or give wrongly, and how it is to be read.
struct ClipUnits {
    MotionReadOptions reading = {};         ///< with the rate, instead of the file's
    std::optional<double> metres_per_unit;  ///< none: the file's, or found from the body's size
    std::optional<double> height{};         ///< of the body, metres; none: found with the unit
    std::optional<glm::dvec3> up{};         ///< axis that points up, unit; none: found
    JointLabels joints{};                   ///< which joint is which bone, as a person said
};

/// Reads a motion file of any format with a skeleton as motion of the built-in skeleton; the clip's
/// name is the file's. The first four frames count as a fault, because converted clips begin in the
/// rest pose. Adds to `warnings` the reader's warnings and what was guessed. Errors: of the reader,
/// the mapping, retargeting. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TrainingClip> load_clip(const std::filesystem::path& path,
                                               const ClipUnits& units,
                                               std::vector<std::string>& warnings);

}  // namespace raks::motion
