#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/pose.hpp"

/// Clip conditioning: prepares recorded motion for training. Faults are bridged, and noise above
/// the frequencies of dancing is filtered out.
namespace raks::motion {

/// Frames [first, last] of a clip, both included.
struct FrameSpan {
    std::size_t first = 0;  ///< first frame
    std::size_t last = 0;   ///< last frame, included
};

/// Replaces the frames of each span by linear interpolation between the sound frames around it (at
/// an end of the clip: by the nearest sound frame). Spans are clipped to the clip; a clip that is
/// all fault stays as it is. Threads: workers. Real-time: no.
void bridge_faults(std::span<Pose> poses, std::span<const FrameSpan> faults);
/// The same for the places of the feet.
void bridge_faults(std::span<std::array<SourceFoot, 2>> feet, std::span<const FrameSpan> faults);

/// Taps of a symmetric low-pass (sinc under a Hann window, three half-waves to each side, sum 1):
/// no phase shift. `cutoff` in Hz, below frames_per_second / 2, both > 0; a cutoff at or above that
/// gives the single tap 1. Threads: any. Real-time: no.
[[nodiscard]] std::vector<double> low_pass_taps(double cutoff_hz, double frames_per_second);

/// Convolution with symmetric taps; the ends are repeated. As many values as given.
[[nodiscard]] std::vector<double> filtered(std::span<const double> values,
                                           std::span<const double> taps);

/// Poses whose hips' place and rotations are low-passed: each quaternion's signs are made
/// continuous, its components filtered, then normalised (correct to second order in the angle
/// within the taps' 0.2 s).
[[nodiscard]] std::vector<Pose> filtered(std::span<const Pose> poses, std::span<const double> taps);

}  // namespace raks::motion
