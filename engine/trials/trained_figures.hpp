#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Every trained figure of a dance and role in its folder (DANCE_*_ROLE.json; of positions
/// DANCE_*_ROLE_positions.json), sorted by file name: what the dancer's figures are measured
/// against. Errors: there is none; a bad file. Threads: workers.
[[nodiscard]] Expected<std::vector<motion::FigureModel>> trained_figures(
    const CatalogueEntry& dance,
    motion::DanceRole role,
    motion::FigureFeatures features = motion::FigureFeatures::angles);

}  // namespace raks::engine
