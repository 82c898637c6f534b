#pragma once

#include <cstddef>

#include "base/random.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// Adds to a figure's trajectory what one repeat differs by from the next: for each feature a
/// smooth curve over the phase (the first harmonics of the figure), as wide as the states' own
/// variance, features together as the part's covariance says. White draws from the trajectory's
/// posterior would shake the feet; people differ slowly.
/// Closed, as the trajectory is. `random`: one stream a repeat and part.
/// Threads: workers. Real-time: no.
void vary(const PartModel& part, const CounterRandom& random, FeatureTrack& track);

}  // namespace raks::motion
