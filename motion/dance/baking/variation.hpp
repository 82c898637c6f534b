// Variation: how one repeat of a figure differs from the next.
#pragma once

#include <cstddef>

#include "base/random.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// Adds to a figure's trajectory how one repeat differs from the next: for each feature a smooth
/// curve over the phase (a constant and the first harmonics of the figure), scaled by the states'
/// deviation and correlated between features by the part's covariance. (White draws from the
/// trajectory's posterior would shake the feet; people differ slowly.) The track stays closed.
/// `random`: one stream a repeat and part. Threads: workers. Real-time: no.
void vary(const PartModel& part, const CounterRandom& random, FeatureTrack& track);

}  // namespace raks::motion
