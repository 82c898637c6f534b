// Acclaim: a skeleton (.asf) and motion for it (.amc), as CMU and HDM05 give their captures.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

/// What one number of a bone's line means: a way along or a turn about its axis, or its length.
enum class AcclaimFreedom : std::uint8_t { tx, ty, tz, rx, ry, rz, length };

/// A skeleton of bones. Each becomes the joint at its near end; at rest joints have the world's
/// axes.
struct AcclaimSkeleton {
    std::vector<ClipJoint> joints;  ///< the root first; parents before their children
    std::vector<glm::dquat> axes;   ///< by joint: in which frame its turns are
    std::vector<std::vector<AcclaimFreedom>> freedoms;  ///< by joint, in the order of its numbers
    std::optional<double> metres_per_unit;  ///< known where the file has CMU's scale of 0.45
};

/// Reads an .asf. A bone's place is that of its near end: its parent's far end. Its turns are about
/// its own `axis`, in the order of `dof`, of which the first comes first (for "rx ry rz" the turn
/// is Rz Ry Rx). Errors, one line with its number: no .asf, a bone twice, without direction or
/// length, not in the hierarchy or twice in it, more than 1,000, numbers that are not finite.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<AcclaimSkeleton> parse_asf(std::string_view text, std::string_view name);

/// Reads an .amc of that skeleton, in degrees or radians as it says. The format has no frame rate:
/// without one, 120 a second are taken, as most of CMU's captures have, and a warning says so.
/// Errors, one line with its number: no .amc, a bone that the skeleton does not have, too few or
/// too many numbers, a bone without numbers in a frame. Threads: workers. Real-time: no.
[[nodiscard]] Expected<MotionClip> parse_amc(std::string_view text,
                                             std::string_view name,
                                             const AcclaimSkeleton& skeleton,
                                             std::optional<double> frames_per_second);

/// The .asf that lies beside an .amc: of the same name (60_01.asf), of what comes before the last
/// "_" (60.asf), of the name that the .amc says (`text` is its content), or the only one there.
/// Errors: none or several, with the option that names it.
[[nodiscard]] Expected<std::filesystem::path> find_asf(const std::filesystem::path& amc,
                                                       std::string_view text);

}  // namespace raks::motion
