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
/// against. Where this form of the dance is danced of cells (is_of_cells) its takes. Errors: there
/// is none; a bad file; a follow of a dance of cells. Threads: workers.
[[nodiscard]] Expected<std::vector<motion::FigureModel>> trained_figures(
    const CatalogueEntry& dance, motion::DanceRole role, const DanceForm& form);

/// Which landings a dance is judged by. People place steps of a free dance anywhere: of a dance of
/// cells those that the take has more than .15 beat from a beat are left out. Threads: any.
[[nodiscard]] motion::JudgedLandings judged_landings(bool is_of_cells);

}  // namespace raks::engine
