#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Every trained figure of a dance and role in its folder (DANCE_*_ROLE.json; of positions
/// DANCE_*_ROLE_positions.json), sorted by file name: what the dancer's figures are measured
/// against. Where this form of the dance is danced of cells (is_of_cells) its takes: see
/// takes_of(). Errors: there is none; a bad file; a follow of a dance of cells. Threads: workers.
[[nodiscard]] Expected<std::vector<motion::FigureModel>> trained_figures(
    const CatalogueEntry& dance, motion::DanceRole role, const DanceForm& form);

/// The takes of a dance of cells as the figures that it is measured against: at each beat of a take
/// that is a cell, each foot is to land when it did in the take (Cell::landings). Threads: any.
[[nodiscard]] std::vector<motion::FigureModel> takes_of(motion::CellDance dance);

/// Which landings a dance is judged by. People place steps of a free dance anywhere: of a dance of
/// cells those that the take has more than .15 beat from a beat are left out. Threads: any.
[[nodiscard]] motion::JudgedLandings judged_landings(bool is_of_cells);

}  // namespace raks::engine
