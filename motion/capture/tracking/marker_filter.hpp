// Marker filter: Kalman's filter over place and velocity of one marker, and its smoother.
#pragma once

#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// What is believed of a marker at one moment: place and velocity with their covariances. The
/// covariance is [[place, mixed], [mixed^T, velocity]].
struct MarkerBelief {
    glm::dvec3 place{};             ///< metres
    glm::dvec3 velocity{};          ///< metres a second
    glm::dmat3 place_covariance{};  ///< square metres
    glm::dmat3 mixed_covariance{};  ///< of place (rows) and velocity (columns)
    glm::dmat3 velocity_covariance{};

    /// Standard deviation along the worst axis, at most (the root of the trace); metres.
    [[nodiscard]] double deviation() const noexcept;
};

/// A place that was measured.
struct MeasuredPlace {
    glm::dvec3 place{};
    glm::dmat3 covariance{};
};

/// A belief at a first sighting: at rest, give or take a metre a second.
[[nodiscard]] MarkerBelief first_belief(const MeasuredPlace& measured);

/// The belief `seconds` later, under white acceleration of density `q` (m/s^2 over the step).
[[nodiscard]] MarkerBelief predicted(const MarkerBelief& belief, double seconds, double q);

/// The belief after a measurement.
[[nodiscard]] MarkerBelief updated(const MarkerBelief& belief, const MeasuredPlace& measured);

/// Squared distance of a measurement from a belief, in standard deviations (3 degrees of freedom).
[[nodiscard]] double innovation(const MarkerBelief& belief, const MeasuredPlace& measured);

/// The beliefs of a run of frames after all of its measurements, those that follow included (Rauch,
/// Tung and Striebel 1965). `measured`: by frame, `seconds` apart; the first is there.
[[nodiscard]] std::vector<MarkerBelief> smoothed(
    const std::vector<std::optional<MeasuredPlace>>& measured, double seconds, double q);

}  // namespace raks::capture
