#include "motion/figures/source_body.hpp"

namespace raks::motion {

Skeleton source_body(const FigureModel& model) noexcept {
    // Scaled by the hips' height alone: proportions are the built-in ones.
    const Skeleton& built_in = mannequin_skeleton();
    return scaled(built_in, static_cast<float>(model.source_hips_height) / built_in.hips_height());
}

}  // namespace raks::motion
