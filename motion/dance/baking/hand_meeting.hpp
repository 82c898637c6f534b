#pragma once

#include <span>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Lets hands that meet in a figure (a clap) meet in each of its repeats, too: where the palms of
/// `learnt` are near one another, those of `varied` come as near and as they lie to one another
/// there, as the chest sees it, but not into one another; both hands go half of the way, by the
/// arms alone. Softly, from 60 cm apart on; a figure whose palms never come within 8 cm is left
/// alone. Poses of the same moments. Threads: workers. Real-time: no.
void meet_hands(const Skeleton& skeleton, std::span<const Pose> learnt, std::span<Pose> varied);

}  // namespace raks::motion
