// Files of rigs: our own, those of Anipose, Pose2Sim and Caliscope, which are read alike, and any
// that Raks understands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"

/// The format (TOML; docs/file_formats.md): one table a camera, in the order of the file.
///
///     [cam_0]                       # or [cameras.0]
///     name = "left"                 # else cam_0
///     size = [1280, 720]            # pixels
///     matrix = [[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
///     distortions = [k1, k2, p1, p2, k3]   # none, 4, 5 or 8 numbers
///     rotation = [x, y, z]          # camera from world: Rodrigues' vector, or three rows
///     translation = [x, y, z]       # camera from world
///     rotation_matrix = [...]       # ours: the same rotation, as three rows, to the last bit
///     [metadata]
///     unit = "m"                    # ours: or "mm"
///     up = "y"                      # ours: or "z"
///     floor = "unknown"             # ours: or "feet"; left out: y = 0
///
/// Threads: any. Real-time: no.
namespace raks::capture {

/// Which axis of a file's world points up.
enum class UpAxis : std::uint8_t {
    y,  ///< as in all Raks
    z   ///< (x, y, z) becomes (x, z, -y)
};

/// How to understand a file that does not say it itself; where both speak, this does.
struct RigReading {
    std::optional<double> metres_per_unit;  ///< 0.001: the file is in millimetres
    std::optional<UpAxis> up;               ///< none, and none in the file: y
};

/// A rig and what was done to it.
struct RigFile {
    Rig rig;                         ///< metres, y up; passed check_rig
    std::vector<std::string> notes;  ///< one line each: what was converted, assumed or left out
};

/// Reads a rig. Tables without a camera matrix that are not called "cam...", such as [metadata],
/// are passed over. `name`: the file's, for messages. Errors, with file, line and camera: TOML that
/// is none; a value missing or of the wrong shape; a camera that is not calibrated; a skewed or
/// fisheye lens; rotation and rotation_matrix that differ; what check_rig refuses.
[[nodiscard]] Expected<RigFile> parse_rig(std::string_view text,
                                          const std::string& name,
                                          const RigReading& reading = {});

/// The same from a file; also one of Qualisys (qualisys_rig.hpp), or one of EasyMocap's two
/// (easymocap_rig.hpp), by its content.
[[nodiscard]] Expected<RigFile> read_rig(const std::filesystem::path& path,
                                         const RigReading& reading = {});

/// A rig of any file in metres and with y up: by what the file says, and before that by what is
/// given. `name`: the file's, for messages. Errors: what check_rig refuses.
[[nodiscard]] Expected<RigFile> settled_rig(RigFile file,
                                            const RigReading& said,
                                            const RigReading& given,
                                            const std::string& name);

/// A rig as a text that Anipose and Pose2Sim read too, and that parse_rig reads back to the same
/// bits.
[[nodiscard]] std::string rig_text(const Rig& rig);

}  // namespace raks::capture
