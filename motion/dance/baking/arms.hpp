// Arms: arms of constant lengths, and hands that meet, in means and in varied passages.
#pragma once

#include <span>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

// Arm directions: keeps arms of position features at their lengths.

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

// Hand meeting: claps stay claps in varied passages.

/// Makes hands that meet in a figure (a clap) meet in its varied repeats, too. Where the palms of
/// `learnt` come near one another, those of `varied` are moved to the same distance and direction
/// from one another, in the frame of the chest, but not into one another; each hand goes half of
/// the way, by its arm alone. The effect fades in from 60 cm apart; a figure whose palms never come
/// within 8 cm is left alone. The two rows of poses are of the same moments. Threads: workers.
/// Real-time: no.
void meet_hands(const Skeleton& skeleton, std::span<const Pose> learnt, std::span<Pose> varied);

}  // namespace raks::motion
