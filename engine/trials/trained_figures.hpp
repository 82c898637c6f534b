#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Every trained figure of a dance and role that comes with Raks (models/trained/DANCE_*_ROLE.json,
/// of positions DANCE_*_ROLE_positions.json), by file name: what the dancer's figures are measured
/// against. Errors: none there; a bad file.
[[nodiscard]] Expected<std::vector<motion::FigureModel>> trained_figures(
    const std::string& dance,
    motion::DanceRole role,
    motion::FigureFeatures features = motion::FigureFeatures::angles);

}  // namespace raks::engine
