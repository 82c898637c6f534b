// Trajectory: the feature curves of a figure generated from its states.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/random.hpp"
#include "motion/dance/baking/feature_pose.hpp"
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

// The paper's synthesis (Ofli 2008, section 5): states of the parts' HMMs paced by the beat, a
// Gaussian draw from each, smoothed.

/// The state of every sample of a figure, by Part; all three advance by the same draws.
using CoupledPath = std::array<std::vector<std::size_t>, 3>;

/// States of one repeat. At sample t of count c a part in state i stays with a chance in proportion
/// to a(i, i) x occurrence(c, i) or goes on to the next state by a(i, i + 1) x occurrence(c, i +
/// 1): its HMM's transitions, weighted by the table of counts against states. Where both products
/// are zero and a later state occurs at the count (the part is late), it goes on at once. The parts
/// share one draw a sample, so that legs, arms and torso run late or early together. `random`:
/// numbers 1 to T - 1 are used. (The table is what couples the parts to the beat in the paper; the
/// shared draw is an addition.) Threads: workers. Real-time: no.
[[nodiscard]] CoupledPath coupled_path(const FigureModel& model, const CounterRandom& random);

/// One repeat: a draw from the state's Gaussian at every sample (one by CovarianceKind), then a
/// median and a Gaussian filter over the phase, closed: 9 frames and a deviation of 3 frames of 60
/// a second at the learnt tempo. Each feature on its own, as in the paper. `repeat` tells repeats
/// apart: same number, same bits. Threads: workers. Real-time: no.
[[nodiscard]] FigureTracks drawn_tracks(const FigureModel& model,
                                        std::uint64_t figure,
                                        std::uint64_t repeat);

}  // namespace raks::motion
