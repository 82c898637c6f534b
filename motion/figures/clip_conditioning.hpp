#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/pose.hpp"

/// Making recorded motion fit to learn from: faults bridged, noise above dancing filtered out.
namespace raks::motion {

/// Frames [first, last] of a clip, both included.
struct FrameSpan {
    std::size_t first = 0;
    std::size_t last = 0;
};

/// Replaces the frames of each span by a straight way between the frames around it (at an end of
/// the clip: by the nearest sound frame). Spans are clipped to what there is; a clip that is all
/// fault stays as it is.
void bridge_faults(std::span<Pose> poses, std::span<const FrameSpan> faults);
void bridge_faults(std::span<std::array<SourceFoot, 2>> feet, std::span<const FrameSpan> faults);

/// Taps of a symmetric low-pass (sinc under a Hann window, three half-waves to each side, sum 1):
/// no phase shift. `cutoff` < frames_per_second / 2, both > 0; a cutoff at or above that gives the
/// single tap 1.
[[nodiscard]] std::vector<double> low_pass_taps(double cutoff_hz, double frames_per_second);

/// Convolution with symmetric taps; ends are held.
[[nodiscard]] std::vector<double> filtered(std::span<const double> values,
                                           std::span<const double> taps);

/// The hips' place and all rotations low-passed: quaternions brought to one side, filtered by
/// component and normalized (right to second order in the angle within the taps' 0.2 s).
[[nodiscard]] std::vector<Pose> filtered(std::span<const Pose> poses, std::span<const double> taps);

}  // namespace raks::motion
