// Trajectory: the feature curves of a figure generated from its states.
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

/// Restores the amplitude that averaging over repeats takes away. Within one repeat a feature has
/// the variance G (`global_variance`). The states' own variance V, which repeats do not share, is
/// missing from a mean trajectory, so it is scaled by sqrt(G / (G - V)), at most x 1.6 (arms differ
/// between takes by the hold, which is no loss of amplitude). Joint rotations and places scale
/// about their mean, velocities about zero, so that a changed state changes its own slice alone.
/// `amount`, 0 to 1, is the share of the scaling that is applied. The travel of the hips gets all
/// of it: scaled as little as fast toes allow, they covered 0.8 of people's way. Threads: workers.
/// Real-time: no.
void restore_variance(const PartModel& part, double amount, FeatureTrack& track);

/// The same closed curve with `factor` times as many rows (Catmull-Rom). Threads: workers.
/// Real-time: no.
[[nodiscard]] FeatureTrack upsampled(const FeatureTrack& track, std::size_t factor);

}  // namespace raks::motion
