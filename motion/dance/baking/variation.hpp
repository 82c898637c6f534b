// Variation: what a mean over repeats lacks: how one repeat differs from the next, and detail.
#pragma once

#include "base/random.hpp"
#include "motion/dance/baking/feature_pose.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

/// Adds to a figure's trajectory how one repeat differs from the next: for each feature a smooth
/// curve over the phase (a constant and the first harmonics of the figure), scaled by the states'
/// deviation and correlated between features by the part's covariance. (White draws from the
/// trajectory's posterior would shake the feet; people differ slowly.) The track stays closed.
/// `is_captured`: learnt from people (feature_pose.hpp), whose arms and spines differ slowly.
/// `random`: one stream a repeat and part. Threads: workers. Real-time: no.
void vary(const PartModel& part,
          bool is_captured,
          const CounterRandom& random,
          FeatureTrack& track);

// Detail: the quick motion of a dance. A mean over repeats keeps their slow motion and loses the
// quick one (landings, impacts, the body's response), which does not come at the same moment each
// time: a mean's accelerations are a fifth to three quarters of people's. The states know how
// strong they were (the mean square of the delta-delta, FigureState), but not their course.
// (Compare the modulation spectrum's restoration: Takamichi et al. 2016, "Postfilters to modify
// the modulation spectrum for statistical parametric speech synthesis".)

/// How much quick motion averaging removed from a figure, 0 to 1, measured at the hips: 1 where the
/// track's accelerations are below 0.6 of people's, 0 where they are above 0.8. Repeats that are
/// alike, as those of a written dance, lose nothing: what the delta-delta holds in addition is
/// faster than a state. Threads: workers. Real-time: no.
[[nodiscard]] double detail_lost(const FigureModel& model, const FigureTracks& learnt);

/// Adds curves of about one to two cycles a beat with random phases. Their strength at each moment
/// is the square root of what the states' mean squared accelerations there exceed the track's own
/// by; features are correlated by the part's covariance; no feature moves farther (rms) than
/// repeats differ. `amount`: factor of the missing acceleration. Threads: workers. Real-time: no.
void add_detail(const PartModel& part,
                const CounterRandom& random,
                double amount,
                FeatureTrack& track);

}  // namespace raks::motion
