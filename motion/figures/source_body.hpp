// Source body: the skeleton behind a figure's joint positions.
#pragma once

#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// The built-in skeleton, scaled to the body that a figure was learnt from: the joints whose
/// positions are its features. Threads: any. Real-time: yes.
[[nodiscard]] Skeleton source_body(const FigureModel& model) noexcept;

}  // namespace raks::motion
