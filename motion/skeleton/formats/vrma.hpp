// VRM animations: poses as a file that every VRM can play.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/expected.hpp"
#include "motion/skeleton/expression_track.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Poses as a VRM animation (VRMC_vrm_animation 1.0 in a binary glTF 2.0): a node for each of the
/// 52 bones, resting in the skeleton's T-pose; rotations, and the hips' travel in metres, with a
/// key a pose. What does not move has one key. `name`: of the clip. `face`: expressions, each with
/// a node of its own whose x is the weight. Errors: no poses, a rate that is not positive, a pose
/// that is not finite, more than 4 GiB. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> vrma_bytes(const Skeleton& skeleton,
                                               std::span<const Pose> poses,
                                               double poses_per_second,
                                               const std::string& name,
                                               std::span<const ExpressionTrack> face = {});

/// The same as a file, which appears under its name only when complete; the clip has the file's
/// name. Errors: also those of write_file.
[[nodiscard]] Expected<void> write_vrma(const std::filesystem::path& path,
                                        const Skeleton& skeleton,
                                        std::span<const Pose> poses,
                                        double poses_per_second,
                                        std::span<const ExpressionTrack> face = {});

}  // namespace raks::motion
