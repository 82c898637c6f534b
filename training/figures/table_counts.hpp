#pragma once

#include <span>
#include <vector>

#include "motion/figures/label_tables.hpp"

namespace raks::motion {

/// Frames of all beats of a label, the end included, from a table of counts. Counts that are
/// missing (in a break of the phase) are filled in between their neighbours; start and end stand in
/// where their counts are missing.
[[nodiscard]] std::vector<double> beat_frames_of(const FigureLabel& label,
                                                 std::span<const CountTime> counts);

}  // namespace raks::motion
