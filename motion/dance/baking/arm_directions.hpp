#pragma once

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Gives the arms of an upper part of positions their lengths back, along the chain from the
/// shoulder; `body` is the source's (source_body). A mean over repeats whose arms point elsewhere
/// is shorter than an arm (down to a tenth in turns, where holds differ), and the shorter the less
/// it knows where to point: there the direction comes from the moments around it, along the
/// sphere. The track is a closed curve. Threads: workers. Real-time: no.
void restore_arms(const PartModel& part, const Skeleton& body, FeatureTrack& track);

/// The same for a varied track; no bone, and no plane of an elbow, is turned far from `learnt`
/// (restored), or arms could as well be mixed the other way round.
void restore_arms_near(const FeatureTrack& learnt,
                       const PartModel& part,
                       const Skeleton& body,
                       FeatureTrack& track);

}  // namespace raks::motion
