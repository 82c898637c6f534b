#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "motion/skeleton/joint_labels.hpp"
#include "training/figures/figure_trainer.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// What is kept of how a clip leads over the floor.
enum class ClipTravel : std::uint8_t {
    file,  ///< all
    none,  ///< nothing: the body stays where it begins, but for what it sways within 4 s
};
inline constexpr std::array<std::string_view, 2> kClipTravelNames = {"file",
                                                                     "none"};  ///< words for it

/// Units that a motion file may lack or give wrongly, and how it is to be read.
struct ClipUnits {
    MotionReadOptions reading = {};         ///< with the rate, instead of the file's
    std::optional<double> metres_per_unit;  ///< none: the file's, or found from the body's size
    std::optional<double> height{};         ///< of the body, metres; none: found with the unit
    std::optional<glm::dvec3> up{};         ///< axis that points up, unit; none: found
    JointLabels joints{};                   ///< which joint is which bone, as a person said
    ClipTravel travel = ClipTravel::file;   ///< how much of the way is kept
};

/// The take that a clip is: its file's name without extension, with #NAME where the clip is one of
/// several in it (FILE#NAME); of a folder its name.
[[nodiscard]] std::string take_name(const std::filesystem::path& clip);

/// Reads a motion file of any format with a skeleton as motion of the built-in skeleton; the clip's
/// name is its take_name. The first four frames of a clip that begins in a rest pose count as a
/// fault: converted clips do. Adds to `warnings` the reader's warnings and what was guessed.
/// Errors: of the reader, the mapping, retargeting. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TrainingClip> load_clip(const std::filesystem::path& path,
                                               const ClipUnits& units,
                                               std::vector<std::string>& warnings);

}  // namespace raks::motion
