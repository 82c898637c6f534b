#pragma once

#include <span>
#include <vector>

#include "motion/figures/label_tables.hpp"

namespace raks::motion {

/// Frames of all beats of a label, the end included, from a table of counts. A count that the table
/// lacks (where the phase breaks) is interpolated between its neighbours; the label's start and end
/// stand in for a missing first or last count. Size: label.beats + 1.
[[nodiscard]] std::vector<double> beat_frames_of(const FigureLabel& label,
                                                 std::span<const CountTime> counts);

}  // namespace raks::motion
