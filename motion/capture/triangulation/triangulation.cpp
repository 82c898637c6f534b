#include "motion/capture/triangulation/triangulation.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr double kNearest = 1e-3;  // metres in front of a camera

double focal_length(const Lens& lens) noexcept { return 0.5 * (lens.fx + lens.fy); }

// Derivative of the direction (x / z, y / z) by the world's axes, as two rows.
struct DirectionJacobian {
    glm::dvec3 x;
    glm::dvec3 y;
};

DirectionJacobian jacobian_of(const Camera& camera, const glm::dvec3& in_camera) noexcept {
    const glm::dmat3 rows = glm::transpose(camera.rotation);
    const double z = in_camera.z;
    return {(rows[0] - in_camera.x / z * rows[2]) / z, (rows[1] - in_camera.y / z * rows[2]) / z};
}

// The sums of one of Gauss' and Newton's steps.
struct NormalEquations {
    glm::dmat3 matrix{0.0};
    glm::dvec3 vector{};
};

std::optional<NormalEquations> equations_at(const Rig& rig,
                                            std::span<const PointView> views,
                                            std::span<const std::size_t> used,
                                            const glm::dvec3& place,
                                            double sigma) {
    constexpr double kCauchy = 2.5;
    NormalEquations sums;
    for (const std::size_t i : used) {
        const Camera& camera = rig.cameras[views[i].camera];
        const glm::dvec3 at = camera.in_camera(place + views[i].shift);
        if (at.z < kNearest) {
            return std::nullopt;
        }
        const double scale = focal_length(camera.lens) / sigma;
        const glm::dvec2 miss = (views[i].direction - glm::dvec2(at.x / at.z, at.y / at.z)) * scale;
        const double weight = views[i].weight / (1.0 + glm::dot(miss, miss) / (kCauchy * kCauchy));
        const DirectionJacobian j = jacobian_of(camera, at);
        const glm::dvec3 x = j.x * scale;
        const glm::dvec3 y = j.y * scale;
        sums.matrix += weight * (glm::outerProduct(x, x) + glm::outerProduct(y, y));
        sums.vector += weight * (x * miss.x + y * miss.y);
    }
    return sums;
}

// The most likely place for the views in use, and its covariance.
std::optional<TriangulatedPoint> refined(const Rig& rig,
                                         std::span<const PointView> views,
                                         std::vector<std::size_t> used,
                                         glm::dvec3 place,
                                         double sigma) {
    constexpr int kMostSteps = 6;
    constexpr double kEnough = 1e-6;  // metres
    glm::dmat3 information(0.0);
    for (int step = 0; step < kMostSteps; ++step) {
        const auto sums = equations_at(rig, views, used, place, sigma);
        if (!sums || !(std::abs(glm::determinant(sums->matrix)) > 1e-12)) {
            return std::nullopt;
        }
        information = sums->matrix;
        const glm::dvec3 move = glm::inverse(information) * sums->vector;
        place += move;
        if (glm::length(move) < kEnough) {
            break;
        }
    }
    TriangulatedPoint point;
    point.place = place;
    point.covariance = glm::inverse(information);
    point.views = std::move(used);
    double squares = 0.0;
    for (const std::size_t i : point.views) {
        const double residual = view_residual(rig, views[i], place);
        squares += residual * residual;
    }
    point.residual = std::sqrt(squares / static_cast<double>(point.views.size()));
    return std::isfinite(point.residual) ? std::optional(std::move(point)) : std::nullopt;
}

}  // namespace

double TriangulatedPoint::deviation() const noexcept {
    return std::sqrt(std::max(0.0, covariance[0][0] + covariance[1][1] + covariance[2][2]));
}

std::optional<glm::dvec3> triangulate_linear(const Rig& rig, std::span<const PointView> views) {
    if (views.size() < 2) {
        return std::nullopt;
    }
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();
    for (const PointView& view : views) {
        const Camera& camera = rig.cameras[view.camera];
        const glm::dmat3 rows = glm::transpose(camera.rotation);
        const glm::dvec3 t = camera.translation + camera.rotation * view.shift;
        for (int axis = 0; axis < 2; ++axis) {
            const glm::dvec3 row = view.direction[axis] * rows[2] - rows[axis];
            const Eigen::Vector4d equation =
                view.weight *
                Eigen::Vector4d(row.x, row.y, row.z, view.direction[axis] * t.z - t[axis]);
            sums += equation * equation.transpose();
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sums);
    const Eigen::Vector4d smallest = solver.eigenvectors().col(0);
    if (!(std::abs(smallest[3]) > 1e-9) || !(solver.eigenvalues()[1] > 1e-12)) {
        return std::nullopt;
    }
    return glm::dvec3(smallest[0], smallest[1], smallest[2]) / smallest[3];
}

double view_residual(const Rig& rig, const PointView& view, const glm::dvec3& place) {
    const Camera& camera = rig.cameras[view.camera];
    const glm::dvec3 at = camera.in_camera(place + view.shift);
    if (at.z < kNearest) {
        return std::numeric_limits<double>::infinity();
    }
    return glm::distance(view.direction, glm::dvec2(at.x / at.z, at.y / at.z)) *
           focal_length(camera.lens);
}

std::optional<TriangulatedPoint> triangulate(const Rig& rig,
                                             std::span<const PointView> views,
                                             double sigma) {
    const std::optional<glm::dvec3> start = triangulate_linear(rig, views);
    if (!start) {
        return std::nullopt;
    }
    std::vector<std::size_t> used(views.size());
    std::iota(used.begin(), used.end(), std::size_t{0});
    std::optional<TriangulatedPoint> point = refined(rig, views, used, *start, sigma);
    while (point && used.size() > 2) {
        const auto worst = std::max_element(used.begin(), used.end(), [&](auto a, auto b) {
            return view_residual(rig, views[a], point->place) <
                   view_residual(rig, views[b], point->place);
        });
        if (!(view_residual(rig, views[*worst], point->place) > 4.0 * sigma + 2.0)) {
            break;
        }
        used.erase(worst);
        point = refined(rig, views, used, point->place, sigma);
    }
    return point;
}

}  // namespace raks::capture
