#pragma once

#include <span>

#include "base/time.hpp"
#include "motion/dance/figure_passage.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// How much later a figure's steps come down in a passage, danced at its learnt tempo, than they
/// were learnt to: the median over its counts (landing: foot_events.hpp; smoothing moves it either
/// way). Zero without steps. Threads: workers. Real-time: no.
[[nodiscard]] Nanos landing_delay(const FigureModel& model,
                                  const FigurePassage& passage,
                                  const Skeleton& skeleton);

}  // namespace raks::motion
