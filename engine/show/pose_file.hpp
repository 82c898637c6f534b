#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::engine {

/// Reads one posture. `argument`: "FILE.json" or "FILE.json#NAME". The file holds postures by name
/// under "poses" (at the top or in "test_poses"), or is one posture: rotations of bones by VRM's
/// names, [x, y, z, w] against the T-pose. Bones that it does not name are not turned; other
/// entries are left alone. Without NAME it must hold one posture. Errors: those of read_file, not
/// JSON, no such posture (the nearest is named), a rotation that is none.
[[nodiscard]] Expected<motion::Pose> read_pose(const std::string& argument);

/// The same from text. `name`: of the posture; empty: the only one.
[[nodiscard]] Expected<motion::Pose> parse_pose(std::string_view text, std::string_view name);

}  // namespace raks::engine
