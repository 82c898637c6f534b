#pragma once

#include "base/random.hpp"
#include "motion/dance/baking/feature_pose.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

/// What is quick in a dance. A mean over repeats keeps their slow motion and loses the quick one
/// (landings, impacts, the body's answer to them), which does not come at the same moment each
/// time: its accelerations are a fifth to three quarters of people's. How strong they are is in the
/// states (the mean square of the delta-delta, FigureState), how they lie is not. (The modulation
/// spectrum's restoration: Takamichi et al. 2016, "Postfilters to modify the modulation spectrum
/// for statistical parametric speech synthesis".)
namespace raks::motion {

/// How much of the quick averaging took away from a figure, 0 to 1, by how the hips move: all of it
/// where the track's accelerations are less than 0.6 of people's, nothing where they are 0.8.
/// Repeats that are alike, as those of a written dance, lose nothing: what their states know
/// besides is quicker than a state. Threads: workers. Real-time: no.
[[nodiscard]] double detail_lost(const FigureModel& model, const FigureTracks& learnt);

/// Adds curves of one to two cycles a beat, as strong at each moment as the
/// states' accelerations there are more than the track's own, features together as the part's
/// covariance says; no feature moves farther for it than repeats differ. `amount`: of the missing.
/// Threads: workers. Real-time: no.
void add_detail(const PartModel& part,
                const CounterRandom& random,
                double amount,
                FeatureTrack& track);

}  // namespace raks::motion
