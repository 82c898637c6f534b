// World points: what a motion file holds, as points in metres with y up, so that two of them can be
// laid over each other.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "motion/skeleton/body/body_finder.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/point_clip.hpp"
#include "motion/skeleton/points/point_edges.hpp"

namespace raks::motion {

/// Points in the world, and what joins them.
struct WorldPoints {
    PointClip clip;                ///< metres, y up
    std::vector<PointEdge> edges;  ///< of a skeleton its bones
    /// How many of the points are there by name; those after them are the tips of a skeleton's
    /// limbs, which are drawn and not compared.
    std::size_t named = 0;
    std::vector<std::optional<Bone>> bones;  ///< by named point, where a body is known
};

/// The joints of a skeleton's motion. A body is found as for retargeting (body_finder.hpp): its up
/// and unit; of anything else `options`, the clip's own, or y and the unit guessed from the rest
/// pose. Places stay where the clip has them: neither the floor nor the heading is changed.
/// Threads: any. Real-time: no.
[[nodiscard]] WorldPoints joint_points(const MotionClip& clip, const BodyOptions& options = {});

/// Recorded points, turned so that `up` (unit length) is y, in metres. Threads: any.
[[nodiscard]] WorldPoints world_points(PointClip clip,
                                       double metres_per_unit,
                                       const glm::dvec3& up,
                                       std::vector<PointEdge> edges = {});

/// Which way a body faces on the whole, by the line of its hip sockets: radians about y, 0 is +z;
/// in the first frame where it turns about. 0 where no body is known, or within half a radian of 0.
[[nodiscard]] double facing_of(const WorldPoints& points);
/// Turns all points about the world's y axis; radians, positive from +z to +x.
void turn_about_y(WorldPoints& points, double radians);

}  // namespace raks::motion
