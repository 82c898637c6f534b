#pragma once

#include <cstddef>
#include <span>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// Sets what the most likely trajectory needs: each state's variances and deltas over its slice of
/// the phase, and the global variance. `tracks`: one a repeat, rows for samples -1 to T + 1.
/// The part has its state means already.
void learn_trajectory(std::span<const FeatureTrack> tracks,
                      std::span<const double> weights,
                      std::size_t samples,
                      PartModel& part);

}  // namespace raks::motion
