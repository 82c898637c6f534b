// Dancer sights: what cameras saw of a dancer's joints at some moments, for their calibration.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/dancer_limbs.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"

namespace raks::capture {

/// A joint in a picture.
struct JointSight {
    glm::dvec2 direction{};  ///< by the lens that is assumed
    double weight = 0.0;     ///< its visibility; 0: not seen
};

/// By camera: the joints at one moment, by kMainPoints.
using DancerMoment = std::vector<std::array<JointSight, kMainPoints.size()>>;

/// Joints that are seen less surely do not count.
inline constexpr double kSureVisibility = 0.5;

/// Up to `most` moments, evenly among those at which two cameras or more see half of the joints.
/// `lenses`: by camera.
[[nodiscard]] std::vector<DancerMoment> dancer_moments(const KeypointTake& take,
                                                       const std::vector<Lens>& lenses,
                                                       std::size_t most);

/// How one camera stands to another, by what both saw of a dancer.
struct CameraPair {
    std::size_t from = 0;
    std::size_t to = 0;
    glm::dmat3 rotation{1.0};  ///< `to` from `from`
    glm::dvec3 translation{};  ///< likewise; metres
    double angle = 0.0;        ///< between their directions to the dancer; degrees
    double agreeing = 0.0;     ///< share of the joints that both see which agree; [0, 1]
    std::size_t shared = 0;    ///< joints that both see
};

/// The pair's essential matrix (five points, RANSAC) from all joints that both see, its size from
/// the lengths of a body `height` metres tall: a start, which the network's errors may lead far
/// astray. `error`: of a joint in a picture / focal length. None: fewer than 60 joints are seen by
/// both, or no such matrix.
[[nodiscard]] std::optional<CameraPair> find_pair(const std::vector<DancerMoment>& moments,
                                                  std::size_t from,
                                                  std::size_t to,
                                                  double error,
                                                  double height);

/// Two upright cameras whose directions to a dancer of that height are `angle` degrees apart, as
/// another start: where the joints are on average, and how large the body is in the picture, tell
/// the rest. Positive angles: `to` stands to the dancer's left of `from`, when he faces that.
/// `sizes`: by camera, height of the body in its pictures / focal length.
[[nodiscard]] CameraPair guess_pair(const std::vector<DancerMoment>& moments,
                                    std::size_t from,
                                    std::size_t to,
                                    double angle,
                                    const std::vector<double>& sizes,
                                    double height);

/// Measures a pair: the angle at the dancer, and which share of the joints both see agree within
/// three times `error` (of a joint in a picture / focal length).
void measure_pair(const std::vector<DancerMoment>& moments, double error, CameraPair& pair);

/// Angle between the directions of two cameras to a place, degrees.
[[nodiscard]] double angle_at(const Camera& one, const Camera& other, const glm::dvec3& place);

}  // namespace raks::capture
