// VMD writer: poses as a motion for MikuMikuDance.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "base/expected.hpp"
#include "motion/skeleton/expression_track.hpp"
#include "motion/skeleton/formats/mmd/mmd_pose_of.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Keys that MikuMikuDance holds, of bones and morphs together.
inline constexpr std::size_t kMostVmdKeys = 600'000;

/// How a VMD is to be written.
struct VmdWriteOptions {
    MmdLegs legs = MmdLegs::ik;
    /// How far a frame that gets no key may be off the line between its keys: bones and places that
    /// move, metres, and turns, radians.
    double place_tolerance = 0.0005;
    double turn_tolerance = 0.0017;
};

/// A VMD, and what it took.
struct WrittenVmd {
    std::string bytes;
    std::size_t keys = 0;
    /// How often the tolerances had to be doubled, so that MikuMikuDance holds the keys.
    int doublings = 0;
};

/// Poses as a VMD of 30 frames a second for bodies whose arms hang by kMmdArmAngle. Frames that lie
/// on the line between their neighbours get no key. Both of legs' goals and turns are written, so
/// that a solver bends knees as the poses have them. `face`: expressions, one weight a pose; those
/// that no common morph stands for are left out. Errors: no poses, a rate that is not positive, a
/// pose that is not finite, more than an hour, more keys than MikuMikuDance holds. Threads:
/// workers. Real-time: no.
[[nodiscard]] Expected<WrittenVmd> vmd_bytes(const Skeleton& skeleton,
                                             std::span<const Pose> poses,
                                             double poses_per_second,
                                             std::span<const ExpressionTrack> face = {},
                                             const VmdWriteOptions& options = {});

/// The same as a file, which appears under its name only when complete. Returns what
/// MikuMikuDance's limit cost, as a line to say; empty: nothing. Errors: also those of write_file.
[[nodiscard]] Expected<std::string> write_vmd(const std::filesystem::path& path,
                                              const Skeleton& skeleton,
                                              std::span<const Pose> poses,
                                              double poses_per_second,
                                              std::span<const ExpressionTrack> face = {},
                                              const VmdWriteOptions& options = {});

}  // namespace raks::motion
