// Free figure: a figure's trajectories as poses on the avatar's skeleton, before its feet are
// planted.
#pragma once

#include <array>
#include <vector>

#include "motion/dance/baking/feature_pose.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Where a figure leads on the floor, in the frame of its start (hips at the origin, heading 0). A
/// dance closes when its figures either come back or end half a turn about one common point.
struct FigurePath {
    int half_turns = 0;  ///< of the hips over the figure; of a take 0
    double turn = 0.0;   ///< of the hips over the figure, radians
    FloorMove move;      ///< from its start to its end; identity, or half a turn
    /// Added to the learnt way, most in the middle of the figure, zero at both ends; left, forward;
    /// metres.
    glm::dvec2 aside{0.0, 0.0};
};

/// A figure's trajectories as learnt, which each passage varies. The amplitude of torso and legs is
/// restored until the toes are as fast as people's (bisection); that of the arms fully. Threads:
/// workers. Real-time: no.
[[nodiscard]] FigureTracks learnt_tracks(const FigureModel& model, const Skeleton& skeleton);

/// Beats of the figure itself that precede and follow it while the feet are planted, so that
/// smoothing at its ends sees motion beyond them.
inline constexpr int kBeatsAround = 2;

/// Poses of one figure with kBeatsAround beats of itself before and after, retargeted to a skeleton
/// along its way; feet are not planted. Two samples for each of the model's. Threads: workers.
/// Real-time: no.
[[nodiscard]] std::vector<Pose> free_poses(const FigureModel& model,
                                           const FigureTracks& tracks,
                                           const FigurePath& way,
                                           const Skeleton& skeleton);

/// Low-pass filters the arms (2 cycles a beat) and hips and trunk (2.5) of a figure of positions;
/// others are left. Sampled joint positions make limb directions noisy where the variance is high,
/// and bones as short as the spine's turn far for a place that moves little. Threads: workers.
/// Real-time: no.
void steady_body(const FigureModel& model, std::vector<Pose>& poses);

/// The free poses of a figure and what their feet do, by Side.
struct FreeFigure {
    int samples_per_beat = 48;  ///< of the poses
    std::vector<Pose> poses;    ///< with kBeatsAround beats before and after the figure
    std::array<std::vector<FootTarget>, 2> feet;  ///< by pose, world
    /// By pose, filtered as for landing detection; m/s at the learnt tempo
    std::array<std::vector<double>, 2> foot_speeds;
};
/// The free poses of a figure with their feet. Threads: workers. Real-time: no (some ms).
[[nodiscard]] FreeFigure free_figure(const FigureModel& model,
                                     const FigureTracks& tracks,
                                     const FigurePath& way,
                                     const Skeleton& skeleton);

}  // namespace raks::motion
