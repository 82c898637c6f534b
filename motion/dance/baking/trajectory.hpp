#pragma once

#include <cstddef>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// The most likely trajectory of one part over one figure that repeats for ever: the values whose
/// values, deltas and delta-deltas together are most probable under the states (Tokuda et al. 2000,
/// "Speech parameter generation algorithms for HMM-based speech synthesis"). One banded Cholesky
/// solve a feature; `samples` rows.
/// A changed state moves it within about one state's length beyond the state's own slice.
/// Threads: workers. Real-time: no.
[[nodiscard]] FeatureTrack most_likely_trajectory(const PartModel& part, std::size_t samples);

/// Restores the amplitude that averaging over repeats takes away. Within one repeat a feature
/// varies by `global_variance`; what the repeats do not share, the states' own variance, is missing
/// from a mean trajectory: it is scaled by sqrt(G / (G - V)), at most x 1.6 (arms differ between
/// takes by the hold, which is no loss of amplitude). Joint rotations and places scale about their
/// mean, velocities about zero: a changed state changes its own slice alone. `amount` of it, 0 to
/// 1, is done, but all of it where the hips travel: held back with the rest, for toes that would
/// else be too fast, they went 0.8 of people's way.
void restore_variance(const PartModel& part, double amount, FeatureTrack& track);

/// The same closed curve with `factor` times as many rows (Catmull-Rom).
[[nodiscard]] FeatureTrack upsampled(const FeatureTrack& track, std::size_t factor);

}  // namespace raks::motion
