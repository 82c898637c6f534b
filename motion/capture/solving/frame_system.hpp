// Frame system: the normal equations of one frame, from what is measured and what bodies can do.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "motion/capture/solving/body_model.hpp"

namespace raks::capture {

/// A marker that is seen at a frame.
struct SeenMarker {
    std::size_t marker = 0;  ///< index in the set
    glm::dvec3 place{};      ///< world, metres
    double deviation = 0.0;  ///< of the place along each axis; metres, > 0
};

/// What is measured at one frame.
struct FrameSight {
    std::vector<SeenMarker> markers;
    /// By Side and SolePoint: how much it stands on the floor, [0, 1].
    std::array<std::array<double, kSolePoints>, 2> planted{};
};

/// Gauss-Newton's equations of one frame: matrix * change = -gradient.
struct FrameSystem {
    Eigen::MatrixXd matrix;    ///< variables x variables
    Eigen::VectorXd gradient;  ///< by variable

    /// All 0.
    void clear(std::size_t variables);
    /// Adds a difference (metres) of a point that moves so, weighted by axis (1 / variance).
    void add(const PointMotion& motion, const glm::dvec3& difference, const glm::dvec3& weight);
    /// Adds what is known of a point that moves so: `pull` and `weight` are gradient and Hessian of
    /// the cost by its place.
    void add(const PointMotion& motion, const glm::dvec3& pull, const glm::dmat3& weight);
};

/// How terms are weighed.
struct FrameWeights {
    double outlier = 0.03;  ///< difference at which a marker counts half; metres
    double usual = 1.0;     ///< weight of the usual posture
};

/// What the terms of a frame need.
struct FrameContext {
    const BodyModel& model;
    const std::vector<motion::Bone>& marker_bones;  ///< by marker
    const BodyShape& shape;
    FrameWeights weights;
};

/// How much a marker's difference counts: 1 if it is small, half at `outlier`.
[[nodiscard]] double marker_trust(const glm::dvec3& difference, double outlier) noexcept;

/// Weight (1 / variance) of the height of a sole's point over the floor: soles are not under it,
/// and where planted on it.
[[nodiscard]] double sole_weight(double planted, double height) noexcept;

/// Adds the limits and usual turns of the joints. Returns the cost.
double add_joint_terms(const FrameContext& context, const BodyState& state, FrameSystem& system);

/// Adds the measured markers, the limits and usual turns of the joints, and the floor: soles are
/// not under it, and where planted on it. Returns the cost (half of the sum of squares).
double add_frame_terms(const FrameContext& context,
                       const BodyState& state,
                       const PlacedBody& body,
                       const FrameSight& sight,
                       FrameSystem& system);

}  // namespace raks::capture
