#pragma once

#include <vector>

#include "training/figures/figure_trainer.hpp"

namespace raks::motion {

/// How far the hips turn over a repeat, radians: positive from +z to +x, full turns counted.
[[nodiscard]] double turn_of(const TrainingClip& clip, const FigureRepeat& repeat);

/// One name stands for turns to either side and half turns more or less; their mean would be none
/// of them. Keeps the repeats whose turn lies within a quarter turn of the commonest (the one with
/// most others within 60 degrees; the first of equals). By repeat: whether it is kept.
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<bool> of_common_turn(const std::vector<TrainingClip>& clips,
                                               const std::vector<FigureRepeat>& repeats);

}  // namespace raks::motion
