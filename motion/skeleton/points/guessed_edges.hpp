// Guessed edges: which recorded points lie on one bone, told from how they move.
#pragma once

#include <cstddef>
#include <vector>

#include "motion/skeleton/point_clip.hpp"
#include "motion/skeleton/points/point_edges.hpp"

namespace raks::motion {

/// Guesses which points are joined: pairs that keep their distance. The edges are a minimum
/// spanning tree over how much the distance of a pair varies (half of the range that 90 % of the
/// frames lie in), of pairs alike the near ones; a pair that varies by more than a fifth of its
/// distance, or is seen together in fewer than a tenth of the frames looked at, joins nothing: what
/// moves apart from the rest stays apart. A clip that does not move joins neighbours.
///
/// Points that are missing now and then, noise and single leaps do not change the tree. Cost: at
/// most 40 million distances, whatever the clip (two seconds at 800 points). Sorted edges. Threads:
/// any. Real-time: no.
[[nodiscard]] std::vector<PointEdge> guess_edges(const PointClip& clip);

}  // namespace raks::motion
