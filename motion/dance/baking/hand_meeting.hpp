// Hand meeting: claps stay claps in varied passages.
#pragma once

#include <span>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Makes hands that meet in a figure (a clap) meet in its varied repeats, too. Where the palms of
/// `learnt` come near one another, those of `varied` are moved to the same distance and direction
/// from one another, in the frame of the chest, but not into one another; each hand goes half of
/// the way, by its arm alone. The effect fades in from 60 cm apart; a figure whose palms never come
/// within 8 cm is left alone. The two rows of poses are of the same moments. Threads: workers.
/// Real-time: no.
void meet_hands(const Skeleton& skeleton, std::span<const Pose> learnt, std::span<Pose> varied);

}  // namespace raks::motion
