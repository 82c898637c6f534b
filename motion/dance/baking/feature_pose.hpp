// Feature pose: from rows of features to poses of the avatar's skeleton.
#pragma once

#include <array>
#include <cstddef>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// One figure's trajectories, by Part; in figures of positions the torso's stays empty.
using FigureTracks = std::array<FeatureTrack, 3>;

/// Whether a figure was learnt from people: captures have no fingers, written figures do. Threads:
/// any. Real-time: yes.
[[nodiscard]] inline bool is_captured(const FigureModel& model) noexcept {
    return model.fist[0].empty() && model.fist[1].empty();
}

/// The track of the part that carries the root features. Threads: any. Real-time: yes.
[[nodiscard]] const FeatureTrack& root_of(const FigureModel& model,
                                          const FigureTracks& tracks) noexcept;

/// The pose given by one row of all parts, on `skeleton`; feet are not planted. `place`: of the
/// hips at that row. `scale`: (skeleton's hips height) / (the source's). Threads: any. Real-time:
/// no (figures of positions take some us).
[[nodiscard]] Pose pose_of_features(const FigureModel& model,
                                    const FigureTracks& tracks,
                                    std::size_t row,
                                    const RootPlace& place,
                                    double scale,
                                    const Skeleton& skeleton) noexcept;

/// Places of joints in the world, by bone, metres. Only those are read that default_joints names
/// for positions.
using JointPlaces = std::array<glm::vec3, kBoneCount>;

/// The pose whose joints lie at these places as far as constant bone lengths allow (places drawn
/// from Gaussians do not keep them), built along the chain from the hips. The hips follow the leg
/// sockets and the spine. Trunk bones point at the next joint and turn with the shoulders; arm
/// bones point at the next joint. (Hands brought to their places would throw the elbow of a
/// straight arm about.) Ankles are brought to their places, the knee to the side where its place
/// lies; soles are level sideways. Places do not tell a bone's turn about itself: it comes from the
/// bend of elbow or knee, and from the parent bone where the limb is straight. Threads: any.
/// Real-time: no.
[[nodiscard]] Pose pose_at(const Skeleton& skeleton, const JointPlaces& places) noexcept;

}  // namespace raks::motion
