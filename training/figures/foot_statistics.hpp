#pragma once

#include <span>

#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::motion {

/// Sets the chance of contact of each toe by phase and the landing offsets by count from the feet
/// of the repeats (foot_events.hpp). A landing belongs to the count from which it lies in
/// [-0.4, 0.6) beats: dancers land late rather than early.
void learn_feet(std::span<const TrainingClip> clips,
                std::span<const FigureRepeat> repeats,
                FigureModel& model);

}  // namespace raks::motion
