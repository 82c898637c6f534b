#pragma once

#include <vector>

#include "training/figures/figure_trainer.hpp"

namespace raks::motion {

/// How far the hips turn over a repeat, radians: positive from +z to +x, full turns counted.
[[nodiscard]] double turn_of(const TrainingClip& clip, const FigureRepeat& repeat);

/// Takes that share a label may turn to either side, or half a turn more or less; their mean would
/// match none of them. Keeps the repeats whose turn lies within 90 degrees of the commonest turn
/// (the one with most others within 60 degrees; the first of equals). One flag a repeat: is it
/// kept?
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<bool> of_common_turn(const std::vector<TrainingClip>& clips,
                                               const std::vector<FigureRepeat>& repeats);

}  // namespace raks::motion
