#pragma once

#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// The built-in skeleton at the size of the body that a figure was learnt from: what its positions
/// are the joints of.
[[nodiscard]] Skeleton source_body(const FigureModel& model) noexcept;

}  // namespace raks::motion
