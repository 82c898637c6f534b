// Landing delay: measures when a passage's steps come down, and aims its contacts by that.
#pragma once

#include <span>

#include "base/time.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// The learnt landings that contacts can be aimed at; the others are set empty. A foot that comes
/// down twice a count has no single moment to aim at, nor has one that jumps: at the top of a jump
/// it is as slow as on the floor. Threads: workers. Real-time: no.
[[nodiscard]] FigureLandings single_landings(const FigureModel& model);

/// How much later a figure's steps come down in a passage, danced at its learnt tempo, than they
/// were learnt to: the median over its steps (landing: foot_events.hpp). Smoothing shifts landings
/// either way. Zero without steps. Threads: workers. Real-time: no.
[[nodiscard]] Nanos landing_delay(const FigureModel& model,
                                  const FigurePassage& passage,
                                  const Skeleton& skeleton);

/// One pass of landing correction. Measures the landings of `passage`, which was made with `aimed`,
/// at `pace` of the learnt tempo, and moves each aimed landing earlier by as much as its step came
/// down late (or later). No landing is moved farther than 0.3 beats from where it was learnt.
/// Threads: workers. Real-time: no.
void aim_landings(const FigureModel& model,
                  const FigurePassage& passage,
                  const Skeleton& skeleton,
                  double pace,
                  FigureLandings& aimed);

}  // namespace raks::motion
