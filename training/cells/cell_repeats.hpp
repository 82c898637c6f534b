#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "training/cells/cell_arcs.hpp"

/// Repeats: where takes dance the same beats again. Nobody labels them.
namespace raks::motion {

/// What counts as a repeat.
struct TieOptions {
    /// Centimetres: distance() of two cells, mean over their course, of which no
    /// moment may be half as far again; 0: nothing is tied. The
    /// nearest other moment of a dance is 10 away, one frame of dancing 1.2 (median, takes of a
    /// dancer).
    double farthest = 8.0;
    std::size_t shortest_run = 2;  ///< beats in a row that agree
};

/// A cell among its repeats.
struct TiedCell {
    std::size_t cell = 0;      ///< index among the cells
    bool is_mirrored = false;  ///< against the first of the repeats
};

/// Cells that are repeats of each other.
using CellRepeats = std::vector<TiedCell>;

/// Finds repeats by the distance of whole courses, the mirror images among them: runs of cells that
/// agree with another run beat by beat, each pair of a group's cells with each other. `cells`: by
/// take and beat. Each group has two cells or more, the lowest first, and no cell is in two groups.
/// Groups come by their first cell. Threads: workers. Real-time: no (the square of the number of
/// cells).
[[nodiscard]] std::vector<CellRepeats> find_cell_repeats(std::span<const CellSource> cells,
                                                         const TieOptions& options = {});

/// Whether cell + 1 is the next beat of the same take. Real-time: yes.
[[nodiscard]] bool goes_on(std::span<const CellSource> cells, std::size_t cell) noexcept;

}  // namespace raks::motion
