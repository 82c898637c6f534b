#pragma once

#include <array>
#include <cstddef>

#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// One figure's trajectories, by Part; of positions the torso's stays empty.
using FigureTracks = std::array<FeatureTrack, 3>;

/// The track of a figure's root part.
[[nodiscard]] const FeatureTrack& root_of(const FigureModel& model,
                                          const FigureTracks& tracks) noexcept;

/// The pose that one row of all parts says, on `skeleton`, feet free. `scale`: (skeleton's hips
/// height) / (the source's). Threads: any. Real-time: no (of positions some us).
[[nodiscard]] Pose pose_of_features(const FigureModel& model,
                                    const FigureTracks& tracks,
                                    std::size_t row,
                                    const RootPlace& place,
                                    double scale,
                                    const Skeleton& skeleton) noexcept;

/// Places of joints in the world, by bone; those that default_joints names of positions are read.
using JointPlaces = std::array<glm::vec3, kBoneCount>;

/// The pose whose joints lie at these places, as far as bones that keep their lengths allow (places
/// drawn from Gaussians do not keep them): restored along the chain from the hips. Hips by the
/// legs' sockets and the spine; the trunk's bones, turned with the shoulders, and the arms' point
/// at the next place; ankles are where they shall be, the knee to the side where its place lies;
/// soles lie level sideways. (Hands brought to their places would throw the elbow of a straight arm
/// about.) A bone's turn about itself is not in places: it comes from the bend of elbow and knee,
/// and from the bone before it where they are straight. Threads: any. Real-time: no.
[[nodiscard]] Pose pose_at(const Skeleton& skeleton, const JointPlaces& places) noexcept;

}  // namespace raks::motion
