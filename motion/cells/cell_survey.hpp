#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/cells/cell_dance.hpp"

namespace raks::motion {

/// How well the cells of a dance hang together; a cell and its mirror image are one.
struct CellSurvey {
    /// Cells of a kind, and how far they are from all cells.
    struct Kind {
        std::size_t cells = 0;    ///< of the kind
        std::size_t far = 0;      ///< cells with none of the kind within kBeatsToKind beats
        std::size_t cut_off = 0;  ///< cells from which no way leads to one
        int farthest = 0;         ///< beats from the others to the next one, at most
        double mean_beats = 0.0;  ///< the same, mean
    };
    /// Of arcs by their distance.
    static constexpr double kStep = 3.0;
    static constexpr std::size_t kSteps = 8;  ///< the last one has all that are longer

    std::size_t connected = 0;  ///< cells of the largest set that reach each other
    std::size_t ends = 0;       ///< cells without a natural successor
    std::size_t without = 0;    ///< cells that no arc leaves
    std::size_t most_arcs = 0;  ///< of one cell
    Kind rest;                  ///< is_rest()
    Kind ending;                ///< is_ending()
    Kind greatest;              ///< is_greatest()
    std::array<std::size_t, kSteps> distances{};    ///< arcs by distance, in steps of kStep
    std::vector<std::vector<std::size_t>> between;  ///< arcs from take to take
};

/// Surveys a graph that passes validate() and whose energies are sorted. Costs its arcs a few times
/// over. Threads: workers. Real-time: no.
[[nodiscard]] CellSurvey survey(const CellGraph& graph);

}  // namespace raks::motion
