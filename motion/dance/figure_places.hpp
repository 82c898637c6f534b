// Figure places: where the figures of a dance begin and lead, and where they stand on the stage.
// Threads: any. Real-time: no (used while a dance is loaded).
#pragma once

#include <span>
#include <vector>

#include "motion/dance/baking/figure_passage.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Ways that close the dance: figures that end turned by an odd number of half turns all turn about
/// one point, so that two of them lead back; the others come back by themselves. The point is the
/// grammar's, or the mean of the figures' own. `grammar`: null, or of these figures in this order.
[[nodiscard]] std::vector<FigurePath> closed_paths(std::span<const FigureModel> figures,
                                                   const Skeleton& skeleton,
                                                   const FigureGrammar* grammar);

/// Where the feet stand as each figure starts; the same for all unless the grammar gives figures
/// stances of their own.
[[nodiscard]] std::vector<StartPlaces> start_places(std::span<const FigureModel> figures,
                                                    const std::vector<FigureTracks>& tracks,
                                                    const std::vector<FigurePath>& ways,
                                                    const Skeleton& skeleton,
                                                    FigureGrammar::Starts starts);

/// Moves the mean place and heading of the first figure to the middle of the stage, facing the
/// audience.
[[nodiscard]] FloorMove stage_of(const LibraryFigure& figure);

/// Stage of one of a couple: the point it turns about lies in the middle of the stage.
[[nodiscard]] FloorMove couple_of(std::span<const FigureModel> figures,
                                  const FigureGrammar* grammar);

/// The same where the follow's place is given as seen from the lead's: the middle between both
/// stands in the middle of the stage, seen from the stance in which the first figure begins.
[[nodiscard]] FloorMove couple_of(const glm::dvec2& apart, DanceRole role, const FloorMove& stance);

/// Moves figures that have a stance of their own so that each begins where the first one would.
void place_figures(const Skeleton& skeleton, std::vector<LibraryFigure>& figures);

}  // namespace raks::motion
