#pragma once

#include <cstddef>
#include <span>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// Sets what the most likely trajectory is computed from: each state's variances and deltas over
/// its slice of the phase, and the global variance. `tracks`: one a repeat, rows for samples -1 to
/// T + 1; `samples`: T. The part already has its state means.
void learn_trajectory(std::span<const FeatureTrack> tracks,
                      std::span<const double> weights,
                      std::size_t samples,
                      PartModel& part);

}  // namespace raks::motion
