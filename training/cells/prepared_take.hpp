#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "training/cells/take_moments.hpp"
#include "training/cells/take_postures.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/training_clip.hpp"

namespace raks::motion {

/// One take, ready to be cut.
struct PreparedTake {
    TrainingClip clip;  ///< at the source's size, completed by rule (rigid_joints.hpp)
    /// Of every frame, low-passed, as if the body had the built-in one's height: takes of two
    /// bodies compare.
    std::vector<TakeMoment> moments;
    /// By Side: fractional frames in which the foot lands, rising.
    std::array<std::vector<double>, 2> landings;
    TakePostures postures;  ///< what of it is no dance
};

/// Cut-off of the filter over a take's motion; Hz.
inline constexpr double kTakeLowPassHz = 10.0;

/// Reads a take and measures it. Adds to `warnings`. Errors: of load_clip(); a clip of fewer than
/// 14 or more than 1000 frames a second, or shorter than a second. Threads: workers. Real-time: no
/// (5 kB a frame).
[[nodiscard]] Expected<PreparedTake> prepare_take(const std::filesystem::path& path,
                                                  const ClipUnits& units,
                                                  std::vector<std::string>& warnings);

/// The same of a clip that is there.
[[nodiscard]] Expected<PreparedTake> prepare_take(TrainingClip clip);

/// Measures the moments anew, after the poses were changed. Threads: workers. Real-time: no.
void measure_moments(PreparedTake& take);

/// Jerk of the frames that count, joint by joint and frame by frame as jerk_of() has it, m/s^3: of
/// the captured motion on a body of the built-in one's height, at 60 frames a second. `counted`: by
/// frame of the clip. Empty for a clip of fewer than 50 frames a second, whose jerk nobody knows.
[[nodiscard]] std::vector<double> jerk_samples(const PreparedTake& take,
                                               const std::vector<bool>& counted);

}  // namespace raks::motion
