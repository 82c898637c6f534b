// Figure statistics: what is learnt of a figure besides its HMMs: its trajectories and its feet.
#pragma once

#include <cstddef>
#include <span>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::motion {

/// Sets the chance of contact of each toe by phase and the landing offsets by count from the feet
/// of the repeats (foot_events.hpp). A landing belongs to the count from which it lies in
/// [-0.4, 0.6) beats: dancers land late rather than early.
void learn_feet(std::span<const TrainingClip> clips,
                std::span<const FigureRepeat> repeats,
                FigureModel& model);

/// Sets what the most likely trajectory is computed from: each state's variances and deltas over
/// its slice of the phase, and the global variance. `tracks`: one a repeat, rows for samples -1 to
/// T + 1; `samples`: T. The part already has its state means.
void learn_trajectory(std::span<const FeatureTrack> tracks,
                      std::span<const double> weights,
                      std::size_t samples,
                      PartModel& part);

}  // namespace raks::motion
