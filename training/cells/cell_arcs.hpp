#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "motion/cells/cell_dance.hpp"
#include "training/cells/take_moments.hpp"

namespace raks::motion {

/// A beat of a take that may be danced, with moments of its course.
struct CellSource {
    Cell cell;                           ///< as it goes into the graph
    TakeMoment start;                    ///< at its first beat
    std::array<TakeMoment, 3> course{};  ///< after a quarter, a half, three quarters of it
    TakeMoment end;                      ///< at the next beat
};

/// How cells are joined.
struct ArcOptions {
    double farthest = 18.0;      ///< distance() of an arc, centimetres
    double widest = 28.0;        ///< of one without which cells would hang together with nothing
    std::size_t most_arcs = 48;  ///< of one cell; the nearest stay
    int threads = 1;             ///< the result is the same for any number
};

/// Cells with their arcs.
struct JoinedCells {
    CellGraph graph;             ///< all cells; `takes`, `beat_seconds`, `energies` are not set
    std::size_t wide_joins = 0;  ///< arcs that are farther than `farthest`
};

/// Joins cells, which come by take and beat, where one ends as another begins: arcs change the half
/// of the bar as the beats of a take do. A cell leads neither to itself nor to its neighbours in
/// the take, nor to their mirror images. The nearest of those within `farthest` are taken. Where
/// cells are not reached from the largest part of the graph or do not lead back to it, further arcs
/// are added, the nearest first and as few as will do; first such that lead to the beginning of
/// what was danced in a row, or from its end. Which of the cells hang together, and so are danced:
/// reached_cells(). Threads: workers. Real-time: no (the square of the number of cells: half a
/// second for a thousand).
[[nodiscard]] JoinedCells join_cells(std::span<const CellSource> cells,
                                     const ArcOptions& options = {});

}  // namespace raks::motion
