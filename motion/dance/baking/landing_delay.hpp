#pragma once

#include <span>

#include "base/time.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// The learnt landings that contacts can be aimed at. A foot that comes down twice a count has no
/// one moment at which it should; nor does one that jumps: at the top it is as slow as on the
/// floor. Threads: workers. Real-time: no.
[[nodiscard]] FigureLandings single_landings(const FigureModel& model);

/// How much later a figure's steps come down in a passage, danced at its learnt tempo, than they
/// were learnt to: the median over its counts (landing: foot_events.hpp; smoothing moves it either
/// way). Zero without steps. Threads: workers. Real-time: no.
[[nodiscard]] Nanos landing_delay(const FigureModel& model,
                                  const FigurePassage& passage,
                                  const Skeleton& skeleton);

/// Aims the contacts anew after a look at a passage that was made with `aimed`: earlier by what
/// each step came down late, or later, danced at `pace` of the learnt tempo, against where people's
/// did. No contact is moved farther than 0.3 beats from its learnt landing. Threads: workers.
/// Real-time: no.
void aim_landings(const FigureModel& model,
                  const FigurePassage& passage,
                  const Skeleton& skeleton,
                  double pace,
                  FigureLandings& aimed);

}  // namespace raks::motion
