#pragma once

#include <cstddef>
#include <span>

#include "motion/figures/figure_model.hpp"
#include "training/cells/cell_arcs.hpp"
#include "training/cells/cell_repeats.hpp"

/// Ties: where takes repeat themselves, one chain of states is learnt from all repeats.
namespace raks::motion {

/// Gives the states of repeats the same means: those of the bodies' rotations and of the hips' way
/// over the examples, all of equal weight, mirrored where the repeat is. Over half a beat at either
/// end of a run that is tied, and where other repeats join, each one goes over to states of its
/// own, deltas and delta-deltas with it: no join is added. `takes`: by Cell::take, of
/// kStatesPerBeat states a beat. Returns how many states are shared, each counted once for each
/// repeat and not for each part of the body. Threads: any. Real-time: no.
std::size_t tie_states(std::span<const CellRepeats> groups,
                       std::span<const CellSource> cells,
                       std::span<FigureModel> takes);

}  // namespace raks::motion
