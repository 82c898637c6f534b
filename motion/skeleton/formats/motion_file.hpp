// Motion file: the one door through which recorded motion comes in, whatever its format.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/point_clip.hpp"

namespace raks::motion {

/// What a motion file holds: a skeleton that moves, or points.
using MotionFile = std::variant<MotionClip, PointClip>;

/// A file, and the name of one of the clips in it.
struct ClipAddress {
    std::filesystem::path file;
    std::string clip;  ///< empty: the first
};
/// "FILE" or "FILE#NAME" apart; a file that has the whole as its name wins.
[[nodiscard]] ClipAddress clip_address(const std::filesystem::path& argument);

/// Reads a clip of a glTF, GLB, VRM or VRMA, at that many frames a second if any are given. Errors:
/// one line with the file's name.
using ModelMotionReader = std::function<Expected<MotionClip>(
    const ClipAddress& address, std::optional<double> frames_per_second)>;

/// What a file may lack or say wrongly. Options that a format has no use for are passed over.
struct MotionReadOptions {
    /// Instead of the file's rate, which may then be anything; > 0.
    std::optional<double> frames_per_second = {};
    /// ASF of an AMC; empty: looked for beside it (find_asf).
    std::filesystem::path skeleton = {};
    /// How far the arms of the body that a motion of MikuMikuDance was made for hang below the
    /// horizon at rest, degrees; none: kMmdArmAngle. Such files do not say it.
    std::optional<double> arm_angle = {};
    /// Models are read by a room that this one does not know (render/import): whoever does, hands
    /// its reader in. Empty: models are refused.
    ModelMotionReader read_model = {};
};

/// Reads a motion file; `path` may be "FILE#NAME" where a file holds several clips. Its format is
/// told by its content, else by its ending. Memory is bounded by the size of the file, at most 256
/// MiB (unpacked: 512 MiB); at most 1,000 joints or points.
///
/// Errors, one line with the file's name and what to do: not there, no motion file, those of the
/// format's reader, of `read_model`.
///
///     const auto file = read_motion("60_01.amc", {});
///     if (file) { std::visit(show, *file); }
///
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<MotionFile> read_motion(const std::filesystem::path& path,
                                               const MotionReadOptions& options);

/// The same where only a skeleton will do. Errors: also points, of which no body is solved.
[[nodiscard]] Expected<MotionClip> read_skeleton_motion(const std::filesystem::path& path,
                                                        const MotionReadOptions& options);

/// The same from bytes: `address` names the file in errors and says where files that belong to it
/// lie. Models are read from their file, as they may be several.
[[nodiscard]] Expected<MotionFile> parse_motion(std::string_view bytes,
                                                const ClipAddress& address,
                                                const MotionReadOptions& options);

}  // namespace raks::motion
