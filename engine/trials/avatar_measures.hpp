// How well an avatar wears a dance: soles on the floor, hands out of the trunk, skin and tails
// whole. All of it is measured on the mesh and the joints as they are drawn.
#pragma once

#include <optional>
#include <span>

#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar.hpp"

namespace raks::engine {

/// The hands against the trunk of the mesh, in pictures.
struct HandMeasures {
    double deepest = 0.0;       ///< of palms and halves of forearms inside the trunk; metres
    double inside_share = 0.0;  ///< of the pictures in which one is more than 2 cm inside
};

/// What swings.
struct TailMeasures {
    bool is_finite = true;        ///< no joint was ever lost
    double stretch = 0.0;         ///< most that a segment's length differs from its own; share
    double longest_inside = 0.0;  ///< longest time that a tail is > 5 mm inside its colliders; s
};

/// What was measured of one avatar in one dance.
struct AvatarMeasures {
    double lowest_sole = 0.0;    ///< of what the feet move, over the floor; metres
    double planted_share = 1.0;  ///< of planted soles within 1 cm of the floor
    double planted_p99 = 0.0;    ///< 99th percentile of their distance from it; metres
    HandMeasures hands;          ///< see there
    double stretch_p995 = 0.0;   ///< 99.5th percentile of a triangle's area against the T-pose
    /// 99th percentile of the distance between the mesh and the mirror image of the mesh in the
    /// mirrored pose; metres. None: the mesh at rest is not symmetric.
    std::optional<double> mirrored_p99;
    std::optional<TailMeasures> tails;  ///< none: nothing swings
};

/// Measures a dance. `poses`: on the avatar's own body (render::retargeted), `rate` a second.
/// Soles and tails are measured in every pose, the rest in about ten a second.
/// Threads: any. Real-time: no.
[[nodiscard]] AvatarMeasures measure_avatar(const render::Avatar& avatar,
                                            std::span<const motion::Pose> poses,
                                            double rate);

}  // namespace raks::engine
