// `raks stick` of points: how they lie in the world, and what joins them.
#pragma once

#include <string>

#include "apps/raks/commands.hpp"
#include "motion/skeleton/point_clip.hpp"
#include "motion/skeleton/points/joint_points.hpp"

namespace raks::apps {

/// Recorded points, ready to be drawn.
struct JoinedPoints {
    motion::WorldPoints points;
    bool is_partly = false;  ///< edges were left out, as they name points that there are none of
};

/// Turns points upright and joins them as `--edges` asks for: unit and axis are as given, as the
/// file says, or else guessed, and edges that name no point are left out, each with a line that
/// says so. `name`: the file's. Errors: of the edges file; a set of which the points have nothing.
[[nodiscard]] Expected<JoinedPoints> join_points(const StickArguments& arguments,
                                                 const std::string& name,
                                                 motion::PointClip clip);

/// What is there of points, as JSON (raks-points).
[[nodiscard]] std::string points_document(const std::string& name,
                                          const motion::WorldPoints& points);

}  // namespace raks::apps
