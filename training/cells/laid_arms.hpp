#pragma once

#include <cstddef>
#include <vector>

#include "motion/figures/label_tables.hpp"
#include "training/cells/cell_cutting.hpp"
#include "training/cells/prepared_take.hpp"

namespace raks::motion {

/// Gives the beats whose arms hang in a robot's home pose (BeatFate::home) the arms that the same
/// take has at other beats that are danced: as many in a row as there are, from the same half of
/// the bar, such whose arms begin and end most as those beside the gap do, each used as seldom as
/// may be. Arms are taken relative to the chest, at the same part of the beat, and go over within
/// a third of a beat. `fates`: of the same take's beats, by cut_take(). Returns how many beats were
/// given arms; it is none where the take has no others. Threads: workers. Real-time: no.
std::size_t lay_arms(PreparedTake& take,
                     const std::vector<TakeBeat>& beats,
                     const std::vector<BeatFate>& fates);

}  // namespace raks::motion
