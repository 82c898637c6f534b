#pragma once

#include <array>
#include <vector>

#include "motion/dance/baking/feature_pose.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/leg_ik.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Where a figure leads on the floor, seen from where its count 1 began (hips at the origin,
/// heading 0). A dance closes when its figures either come back or end half a turn about one common
/// point.
struct FigurePath {
    int half_turns = 0;  ///< of the hips over the figure
    FloorMove move;      ///< from its start to its end; identity, or half a turn
    /// In the middle of the figure, besides what was learnt; left, forward of its start; metres.
    glm::dvec2 aside{0.0, 0.0};
};

/// A figure's trajectories as learnt; what each passage varies. Torso and legs are widened until
/// the toes are as fast as people's.
[[nodiscard]] FigureTracks learnt_tracks(const FigureModel& model, const Skeleton& skeleton);

/// Danced beyond both ends while the feet are planted, so that those know what comes.
inline constexpr int kBeatsAround = 2;

/// One figure with kBeatsAround beats of itself before and after, carried over to a skeleton along
/// its way; no foot is planted.
[[nodiscard]] std::vector<Pose> free_poses(const FigureModel& model,
                                           const FigureTracks& tracks,
                                           const FigurePath& way,
                                           const Skeleton& skeleton);

/// Of a figure of positions: arms of places drawn from Gaussians point here and there where they
/// hardly know where to, and bones as short as the spine's turn far for a place that moves little.
/// What is quicker than two cycles a beat (arms) or two and a half (hips, trunk) is taken off.
void steady_body(const FigureModel& model, std::vector<Pose>& poses);

/// The free poses and what their feet do, by Side.
struct FreeFigure {
    int samples_per_beat = 48;
    std::vector<Pose> poses;
    std::array<std::vector<FootTarget>, 2> feet;     ///< by pose
    std::array<std::vector<double>, 2> foot_speeds;  ///< as landings are seen by; m/s, learnt tempo
};
/// Threads: workers. Real-time: no (some ms).
[[nodiscard]] FreeFigure free_figure(const FigureModel& model,
                                     const FigureTracks& tracks,
                                     const FigurePath& way,
                                     const Skeleton& skeleton);

}  // namespace raks::motion
