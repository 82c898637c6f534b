// Joint labels: which joint of a clip is which bone, said by a person.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// One line of a joint map.
struct JointLabel {
    Bone bone = Bone::hips;
    std::string joint;  ///< name as the clip has it, with any "prefix:"
};

/// What a person says of single joints; the rest is found. A joint map is such a file:
///
///     format = "raks-joint-map"
///     version = 1
///     [joints]
///     leftUpperArm = "bip_l_arm"
///     rightUpperArm = "bip_r_arm"
struct JointLabels {
    std::vector<JointLabel> joints;  ///< each bone once
    std::string source;              ///< where they were read, for messages: "map.toml", "--joint"
};

/// Reads a joint map. `file`: its name, for messages. A key whose value is empty ("") is left to be
/// found, as a map to start from has them. Errors, in one line with their place: not TOML, another
/// format or version, a bone that VRM 1.0 does not know (with the nearest), a value that is no
/// text, one joint under two bones.
[[nodiscard]] Expected<JointLabels> read_joint_map(std::string_view text, const std::string& file);

/// Adds one `leftUpperArm=bip_l_arm` to `labels`; it takes the place of what they say of that bone.
/// Errors: no '=', an unknown bone (with the nearest), a joint that another bone has already.
[[nodiscard]] Expected<void> add_joint_label(std::string_view text, JointLabels& labels);

/// What a person said on the command line: `map`, a joint map (none: empty), and `lines` of the
/// form above, which win. Errors: as of both, of reading the file, and two lines for one bone.
[[nodiscard]] Expected<JointLabels> joint_labels(const std::filesystem::path& map,
                                                 std::span<const std::string> lines);

}  // namespace raks::motion
