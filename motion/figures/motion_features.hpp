#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// Poses to feature vectors and back. Time base and units: figure_model.hpp.
namespace raks::motion {

/// Rotation vector (axis x angle, |v| <= pi) of a unit quaternion. Real-time: yes.
[[nodiscard]] glm::dvec3 exponential_map(const glm::dquat& rotation) noexcept;
/// Its inverse. Real-time: yes.
[[nodiscard]] glm::dquat rotation_from(const glm::dvec3& exponential_map) noexcept;

/// Turn about the vertical of a rotation, the rest of which (`tilt`, with no part about y) comes
/// first: rotation = heading * tilt. Radians in (-pi, pi]. Real-time: yes.
[[nodiscard]] double heading_of(const glm::dquat& rotation) noexcept;

/// Mean of unit quaternions with weights >= 0 (largest eigenvector of the sum of q q^T, Markley
/// 2007); signs do not matter.
[[nodiscard]] glm::dquat mean_rotation(std::span<const glm::dquat> rotations,
                                       std::span<const double> weights);

/// Values of one part over consecutive samples: `rows` x `columns`, row-major.
struct FeatureTrack {
    std::size_t columns = 0;
    std::vector<double> values;

    [[nodiscard]] std::size_t rows() const noexcept {
        return columns == 0 ? 0 : values.size() / columns;
    }
    [[nodiscard]] std::span<double> row(std::size_t i) noexcept {
        return std::span(values).subspan(i * columns, columns);
    }
    [[nodiscard]] std::span<const double> row(std::size_t i) const noexcept {
        return std::span(values).subspan(i * columns, columns);
    }
};

/// The root's features and spine, arms or legs of consecutive poses, one every 1 /
/// samples_per_beat beats. Velocity and yaw rate of row i are those from pose i to i + 1, in the
/// heading halfway; the last row repeats the one before it. `part` needs its part, features and
/// joints only; `body` (whose poses these are) matters to positions only. At least 2 poses where
/// the part has root features.
[[nodiscard]] FeatureTrack features_of(std::span<const Pose> poses,
                                       const PartModel& part,
                                       int samples_per_beat,
                                       const Skeleton& body = mannequin_skeleton());

/// Where the hips stand (x left, y forward of heading 0: the floor's x and z) and which way they
/// face.
struct RootPlace {
    glm::dvec2 position{0.0, 0.0};
    double heading = 0.0;
};

/// What a whole figure does to the place.
struct NetMotion {
    glm::dvec2 displacement{0.0, 0.0};  ///< in the heading frame of the start; metres
    double turn = 0.0;                  ///< radians
};

/// The places of rows 0..rows (one more than rows) from a root part's velocities, from `start`.
/// `scale` multiplies lengths (retargeting). Without `net` it is the inverse of features_of. With
/// `net`, what is missing to it is spread evenly over the rows: turn first, then place.
[[nodiscard]] std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                                    int samples_per_beat,
                                                    const RootPlace& start,
                                                    double scale = 1.0);
[[nodiscard]] std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                                    int samples_per_beat,
                                                    const RootPlace& start,
                                                    double scale,
                                                    const NetMotion& net);

/// Sets the rotations of the part's joints (and, for the torso, the hips: rotation and place) from
/// one row of angles; leaves the other bones. `place` and `scale` matter to the torso only.
/// Threads: any. Real-time: yes.
void apply_features(std::span<const double> row,
                    const PartModel& part,
                    const RootPlace& place,
                    double scale,
                    Pose& pose) noexcept;

/// The joint's place in the world that a row of positions gives it: `local` are its three features.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::dvec3 world_place(std::span<const double> local,
                                     const RootPlace& place,
                                     double scale) noexcept;

}  // namespace raks::motion
