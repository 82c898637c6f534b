// Triangulation: the place of a point that several cameras see.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "motion/capture/camera/rig.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// One camera's view of a point.
struct PointView {
    std::size_t camera = 0;  ///< index in the rig
    glm::dvec2 direction{};  ///< direction_of() its pixel
    /// How far the point had moved when the picture was taken, against the moment that is asked
    /// for: velocity times the difference of the times; metres.
    glm::dvec3 shift{};
    double weight = 1.0;  ///< of its equations; >= 0; 1: it is off by sigma
};

/// Where a point is.
struct TriangulatedPoint {
    glm::dvec3 place{};              ///< world; metres
    glm::dmat3 covariance{0.0};      ///< square metres
    double residual = 0.0;           ///< RMS distance in the views that count; pixels
    std::vector<std::size_t> views;  ///< indices of those that count, two or more

    /// Standard deviation along the worst axis, at most (the root of the trace); metres.
    [[nodiscard]] double deviation() const noexcept;
};

/// The direct linear solution: the smallest eigenvector of the weighted equations
/// `direction * P3 - P12` of all views. None: fewer than two views, all from one place, or a point
/// at infinity. Source: Hartley and Zisserman, Multiple View Geometry, 12.2.
[[nodiscard]] std::optional<glm::dvec3> triangulate_linear(const Rig& rig,
                                                           std::span<const PointView> views);

/// The place that is most likely: the linear solution, then up to six of Gauss' and Newton's steps
/// on pixels with Cauchy's weights 1 / (1 + e^2 / c^2), c = 2.5 sigma. While the worst view is off
/// by more than 4 sigma + 2 pixels and more than two are left, it is dropped. The covariance is
/// sigma^2 (J^T W J)^-1. `sigma`: standard deviation of a pixel's coordinates, > 0. None: as above,
/// and a place behind one of the cameras.
[[nodiscard]] std::optional<TriangulatedPoint> triangulate(const Rig& rig,
                                                           std::span<const PointView> views,
                                                           double sigma);

/// Distance of a place from a view of it; pixels. Infinite: it is behind the camera.
[[nodiscard]] double view_residual(const Rig& rig, const PointView& view, const glm::dvec3& place);

}  // namespace raks::capture
