// Arm directions: keeps arms of position features at their lengths.
#pragma once

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Restores the lengths of both arms in the upper part of a figure of positions, along the chain
/// from the shoulder; `body` is the source's (source_body). A mean over repeats whose arms point in
/// different directions is shorter than an arm (down to a tenth in turns, where holds differ), and
/// the shorter it is the less its direction means: there the direction is interpolated on the
/// sphere from the samples around it. `track` is a closed curve. Threads: workers. Real-time: no.
void restore_arms(const PartModel& part, const Skeleton& body, FeatureTrack& track);

/// The same for a varied track. Each bone's direction and each elbow's plane are held within half a
/// radian of those of `learnt` (restored), so that arms of two passages can be mixed the shorter
/// way round. Threads: workers. Real-time: no.
void restore_arms_near(const FeatureTrack& learnt,
                       const PartModel& part,
                       const Skeleton& body,
                       FeatureTrack& track);

}  // namespace raks::motion
