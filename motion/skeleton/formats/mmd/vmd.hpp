// VMD: motions of MikuMikuDance, in and out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/mmd/mmd_motion.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// The first bytes of a VMD.
inline constexpr std::string_view kVmdMark = "Vocaloid Motion Data";

/// A key of a camera, in our axes and in metres. The camera looks at `target`, from `distance`
/// behind it (below 0: before it) along its own axis.
struct MmdCameraKey {
    std::uint32_t frame = 0;
    float distance = 0.0F;     ///< metres from the target back to the eye
    glm::vec3 target{0.0F};    ///< metres
    glm::vec3 turn{0.0F};      ///< radians about x, y and z, as the file has them
    float view_angle = 30.0F;  ///< degrees, from the lower to the upper edge
    bool has_perspective = true;
    std::array<MmdCurve, 6> curves{};  ///< of x, y, z, the turn, the distance and the view's angle
};

/// What a VMD holds.
struct VmdFile {
    MmdMotion motion;
    std::vector<MmdCameraKey> camera;  ///< sorted by frame, no frame twice
};

/// Frames that a motion may have: an hour.
inline constexpr std::uint32_t kMostMmdFrames = 108'000;

/// Reads a VMD of any age: sections may be missing at the end, keys be in any order, names be cut
/// within a character or be in GBK or UTF-8. Keys of bones that are none of a body (hair, skirts,
/// physics) and of morphs that are not known are counted in a warning. Memory follows the size of
/// the bytes, never a declared count.
///
/// Errors, one line: not a VMD, bytes that end within a record, a count larger than the file, a
/// number that is not finite, or a place above 1e6 units, in a key that is used, a key after more
/// than an hour.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<VmdFile> read_vmd(std::string_view bytes);

}  // namespace raks::motion
