// Point alignment: one motion's points laid over another's.
#pragma once

#include <cstdint>
#include <vector>

#include "base/expected.hpp"
#include "motion/evaluate/point_comparison.hpp"

namespace raks::motion {

/// What is done to the second motion before it is compared.
enum class PointAlignment : std::uint8_t {
    none,   ///< both as they lie in the world
    rigid,  ///< one turn and one move for the whole, that bring it nearest
    hips,   ///< in each frame the hips are laid over each other
    both,   ///< as `hips`, then one turn about them for the whole
};

/// Aligns `other` with `one` by the points that both have, over the frames that both have (least
/// squares: Horn 1987). `other` must be at the frames of `one`. Errors: hips that one of them does
/// not have (a bone, or a point called hips, MidHip, pelvis or the like); fewer than three points
/// in common for a turn. Threads: any.
[[nodiscard]] Expected<void> align(const WorldPoints& one,
                                   WorldPoints& other,
                                   const std::vector<PointPair>& pairs,
                                   PointAlignment alignment);

}  // namespace raks::motion
