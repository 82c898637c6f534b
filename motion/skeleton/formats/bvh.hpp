// BVH: reads and writes Biovision hierarchy files.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How a BVH file is to be read.
struct BvhOptions {
    /// Frames per second that override the file's frame time (which may then even be 0). > 0. (The
    /// CMU salsa clips say 120 where 60 is right.)
    std::optional<double> frames_per_second;
};

/// Reads a Biovision hierarchy. Tolerant where the format is loose: any line ends, keyword case,
/// blanks, byte order mark, wrapped rows, rotation orders and positions of each joint, missing end
/// sites, a wrong frame count (warned), names used twice (warned), several roots (all read,
/// warned). A joint's position channels replace its OFFSET. Numbers are those of the C locale.
///
/// Errors, one line with its line number: not a BVH file, unbalanced braces, unknown or miscounted
/// channels, rows that do not fit the channels, numbers that are not finite or above 1e6, a frame
/// time that is not positive (unless the rate is given), more than 1,000 joints, 100 levels or 10
/// million declared frames. Memory follows the size of the text, never a declared count.
///
///     const auto clip = read_bvh("walk.bvh", {.frames_per_second = 60.0});
///     if (!clip) { report(clip.error().message); }
///
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<MotionClip> read_bvh(const std::filesystem::path& path,
                                            const BvhOptions& options = {});
/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<MotionClip> parse_bvh(std::string_view text,
                                             std::string_view name,
                                             const BvhOptions& options = {});

/// Writes poses as BVH: 52 joints in VRM's names, end sites, ZXY rotations in degrees, metres.
/// The file appears under its name only when complete. Errors: no poses, a rate that is not
/// positive, a pose that is not finite, and those of write_file.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<void> write_bvh(const std::filesystem::path& path,
                                       const Skeleton& skeleton,
                                       std::span<const Pose> poses,
                                       double frames_per_second);

}  // namespace raks::motion
