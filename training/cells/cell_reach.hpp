#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/cells/cell_dance.hpp"

namespace raks::motion {

/// What becomes of a cell of a graph.
enum class CellFate : std::uint8_t {
    stays,
    apart,  ///< it does not reach all that stay, or is not reached from them
    far,    ///< more than kBeatsToKind beats away from a rest, an ending or one of the greatest
};

/// The part of a graph that is danced, and what was left out.
struct ReachedCells {
    CellGraph graph;              ///< cells renumbered, with their energies sorted; may be empty
    std::vector<CellFate> fates;  ///< by cell of the whole graph
    /// Kinds that the part has. Where it lacks one, or keeping that rule would leave less than half
    /// of it, cells need not reach that kind.
    bool has_rests = false;
    bool has_endings = false;   ///< see above
    bool has_greatest = false;  ///< see above
};

/// By cell, whether it is one of the largest set of cells that all reach each other along arcs and
/// successors; of equal sets that of the lowest cell. Threads: workers. Real-time: no (linear).
[[nodiscard]] std::vector<bool> largest_part(const CellGraph& graph);

/// Keeps the largest part of which every cell reaches every other one, and of it the cells that
/// lead to a rest, to an ending and to one of the greatest cells within kBeatsToKind beats; again
/// until nothing changes. A cell and its mirror image are one here: what leads to one leads,
/// mirrored, to the other. Threads: workers. Real-time: no (linear in the arcs, a few times).
[[nodiscard]] ReachedCells reached_cells(CellGraph whole);

}  // namespace raks::motion
