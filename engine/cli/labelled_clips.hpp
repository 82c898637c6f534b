#pragma once

#include <vector>

#include "engine/cli/commands.hpp"
#include "motion/figures/training_plan.hpp"

namespace raks::cli {

/// What both training commands ask of these clips; the rest of the plan is theirs.
[[nodiscard]] motion::FigureTrainingPlan plan_of(const LabelledClips& clips);

/// The files that they are read from.
[[nodiscard]] std::vector<Path> inputs_of(const LabelledClips& clips);

}  // namespace raks::cli
