#pragma once

#include <string>

#include "motion/cells/cell_dance.hpp"
#include "motion/cells/cell_survey.hpp"

namespace raks::apps {

/// One self-contained HTML page of a dance of cells: how many cells and states there are and how
/// they hang together; its takes; which takes' arcs lead to which; the energy of each cell and the
/// arcs that leave it. The same dance gives the same bytes. Threads: any. Real-time: no.
[[nodiscard]] std::string draw_cell_report(const motion::CellDance& dance,
                                           const motion::CellSurvey& survey);

}  // namespace raks::apps
