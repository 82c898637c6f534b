#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motion/cells/cell_dance.hpp"
#include "training/cells/take_moments.hpp"

namespace raks::motion {

/// A beat of a take that may be danced, with the moments at which it begins and ends.
struct CellSource {
    Cell cell;         ///< as it goes into the graph
    TakeMoment start;  ///< at its first beat
    TakeMoment end;    ///< at the next one
};

/// How cells are joined.
struct ArcOptions {
    double farthest = 18.0;      ///< distance() of an arc, centimetres
    std::size_t most_arcs = 48;  ///< of one cell; the nearest stay
};

/// A graph, and what was left out of it.
struct CellArcs {
    CellGraph graph;           ///< `takes` and `beat_seconds` are empty
    std::size_t left_out = 0;  ///< cells from or to which no way leads
    double connected = 0.0;    ///< share of the cells that stayed
};

/// Joins cells, which come by take and beat, where one ends as another begins: arcs change the half
/// of the bar as the beats of a take do. A cell leads neither to itself nor to its neighbours in
/// the take, nor to their mirror images. Of cells without a way out the nearest one is taken
/// whatever its distance. What stays is the largest part of which every cell reaches every other
/// one. Threads: workers. Real-time: no (the square of the number of cells).
[[nodiscard]] CellArcs join_cells(std::span<const CellSource> cells,
                                  const ArcOptions& options = {});

}  // namespace raks::motion
