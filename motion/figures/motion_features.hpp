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

/// Motion features: from poses to feature vectors and back. Time base and units: figure_model.hpp.
namespace raks::motion {

/// Rotation vector (axis x angle, |v| <= pi) of a unit quaternion. Real-time: yes.
[[nodiscard]] glm::dvec3 exponential_map(const glm::dquat& rotation) noexcept;
/// Its inverse. Real-time: yes.
[[nodiscard]] glm::dquat rotation_from(const glm::dvec3& exponential_map) noexcept;

/// Heading of a rotation: its turn about the vertical, where the rest (`tilt`, with no part about
/// y) comes first: rotation = heading * tilt. Radians in (-pi, pi]. Real-time: yes.
[[nodiscard]] double heading_of(const glm::dquat& rotation) noexcept;

/// Mean of unit quaternions with weights >= 0 (largest eigenvector of the sum of q q^T, Markley
/// 2007); signs do not matter.
[[nodiscard]] glm::dquat mean_rotation(std::span<const glm::dquat> rotations,
                                       std::span<const double> weights);

/// Values of one part over consecutive samples: `rows` x `columns`, row-major.
struct FeatureTrack {
    std::size_t columns = 0;     ///< features of one sample
    std::vector<double> values;  ///< rows x columns

    /// Number of samples.
    [[nodiscard]] std::size_t rows() const noexcept {
        return columns == 0 ? 0 : values.size() / columns;
    }
    /// The features of sample i.
    [[nodiscard]] std::span<double> row(std::size_t i) noexcept {
        return std::span(values).subspan(i * columns, columns);
    }
    /// The features of sample i.
    [[nodiscard]] std::span<const double> row(std::size_t i) const noexcept {
        return std::span(values).subspan(i * columns, columns);
    }
};

/// The features of one part of consecutive poses, one pose every 1 / samples_per_beat beats.
/// Velocity and yaw rate of row i are those from pose i to i + 1, in the heading halfway; the last
/// row repeats the one before it. Of `part` only part, features and joints are used; `body` (whose
/// poses these are) matters to positions only. A part with root features needs at least 2 poses.
/// Threads: any. Real-time: no.
[[nodiscard]] FeatureTrack features_of(std::span<const Pose> poses,
                                       const PartModel& part,
                                       int samples_per_beat,
                                       const Skeleton& body = mannequin_skeleton());

/// Where the hips stand (x left, y forward of heading 0: the floor's x and z) and which way they
/// face.
struct RootPlace {
    glm::dvec2 position{0.0, 0.0};  ///< metres
    double heading = 0.0;           ///< radians
};

/// How far a whole figure moves and turns the hips.
struct NetMotion {
    glm::dvec2 displacement{0.0, 0.0};  ///< in the heading frame of the start; metres
    double turn = 0.0;                  ///< radians
};

/// Integrates a root part's velocities from `start`: the places of rows 0..rows (one more than
/// rows). `scale` multiplies lengths (retargeting). Without `net` it is the inverse of features_of.
/// With `net`, the difference to it is spread evenly over the rows: turn first, then place.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                                    int samples_per_beat,
                                                    const RootPlace& start,
                                                    double scale = 1.0);
/// The same, spread to a wanted net motion of the whole figure.
[[nodiscard]] std::vector<RootPlace> integrate_root(const FeatureTrack& root,
                                                    int samples_per_beat,
                                                    const RootPlace& start,
                                                    double scale,
                                                    const NetMotion& net);

/// Sets the rotations of the part's joints (and, for the torso, place and rotation of the hips)
/// from one row of angles; other bones stay. `place` and `scale` matter to the torso only. Threads:
/// any. Real-time: yes.
void apply_features(std::span<const double> row,
                    const PartModel& part,
                    const RootPlace& place,
                    double scale,
                    Pose& pose) noexcept;

/// World place of a joint from its three features of positions, `local`; metres of the target.
/// Threads: any. Real-time: yes.
[[nodiscard]] glm::dvec3 world_place(std::span<const double> local,
                                     const RootPlace& place,
                                     double scale) noexcept;

// Source body: the skeleton behind a figure's joint positions.

/// The built-in skeleton, scaled to the body that a figure was learnt from: the joints whose
/// positions are its features. Threads: any. Real-time: yes.
[[nodiscard]] Skeleton source_body(const FigureModel& model) noexcept;

}  // namespace raks::motion
