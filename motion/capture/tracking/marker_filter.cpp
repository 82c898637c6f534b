#include "motion/capture/tracking/marker_filter.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d block_of(const glm::dmat3& matrix) {
    Eigen::Matrix3d block;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            block(row, column) = matrix[column][row];
        }
    }
    return block;
}

glm::dmat3 matrix_of(const Eigen::Matrix3d& block) {
    glm::dmat3 matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            matrix[column][row] = block(row, column);
        }
    }
    return matrix;
}

Matrix6 covariance_of(const MarkerBelief& belief) {
    Matrix6 covariance;
    const Eigen::Matrix3d mixed = block_of(belief.mixed_covariance);
    covariance << block_of(belief.place_covariance), mixed, mixed.transpose(),
        block_of(belief.velocity_covariance);
    return covariance;
}

// Rounding makes covariances a little asymmetric, and what is asymmetric grows.
glm::dmat3 symmetric(const glm::dmat3& matrix) { return 0.5 * (matrix + glm::transpose(matrix)); }

void set_covariance(MarkerBelief& belief, const Matrix6& covariance) {
    belief.place_covariance = matrix_of(covariance.topLeftCorner<3, 3>());
    belief.mixed_covariance = matrix_of(covariance.topRightCorner<3, 3>());
    belief.velocity_covariance = matrix_of(covariance.bottomRightCorner<3, 3>());
}

}  // namespace

double MarkerBelief::deviation() const noexcept {
    return std::sqrt(
        std::max(0.0, place_covariance[0][0] + place_covariance[1][1] + place_covariance[2][2]));
}

MarkerBelief first_belief(const MeasuredPlace& measured) {
    return {measured.place, {}, measured.covariance, glm::dmat3(0.0), glm::dmat3(1.0)};
}

MarkerBelief predicted(const MarkerBelief& belief, double seconds, double q) {
    const double dt = seconds;
    MarkerBelief next = belief;
    next.place += dt * belief.velocity;
    const glm::dmat3 mixed = belief.mixed_covariance + dt * belief.velocity_covariance;
    next.place_covariance = belief.place_covariance +
                            dt * (glm::transpose(belief.mixed_covariance) + mixed) +
                            glm::dmat3(q * q * dt * dt * dt * dt / 4.0);
    next.mixed_covariance = mixed + glm::dmat3(q * q * dt * dt * dt / 2.0);
    next.velocity_covariance = belief.velocity_covariance + glm::dmat3(q * q * dt * dt);
    return next;
}

MarkerBelief updated(const MarkerBelief& belief, const MeasuredPlace& measured) {
    const glm::dmat3 inverse = glm::inverse(belief.place_covariance + measured.covariance);
    const glm::dmat3 place_gain = belief.place_covariance * inverse;
    const glm::dmat3 velocity_gain = glm::transpose(belief.mixed_covariance) * inverse;
    const glm::dvec3 miss = measured.place - belief.place;
    MarkerBelief next = belief;
    next.place += place_gain * miss;
    next.velocity += velocity_gain * miss;
    next.place_covariance =
        symmetric(belief.place_covariance - place_gain * belief.place_covariance);
    next.mixed_covariance -= place_gain * belief.mixed_covariance;
    next.velocity_covariance =
        symmetric(belief.velocity_covariance - velocity_gain * belief.mixed_covariance);
    return next;
}

double innovation(const MarkerBelief& belief, const MeasuredPlace& measured) {
    const glm::dvec3 miss = measured.place - belief.place;
    return glm::dot(miss, glm::inverse(belief.place_covariance + measured.covariance) * miss);
}

std::vector<MarkerBelief> smoothed(const std::vector<std::optional<MeasuredPlace>>& measured,
                                   double seconds,
                                   double q) {
    std::vector<MarkerBelief> before;  // predicted
    std::vector<MarkerBelief> after;   // with the frame's own measurement
    for (const auto& place : measured) {
        const bool is_first = after.empty();
        before.push_back(is_first ? first_belief(*place) : predicted(after.back(), seconds, q));
        after.push_back(place && !is_first ? updated(before.back(), *place) : before.back());
    }
    Matrix6 step = Matrix6::Identity();
    step.topRightCorner<3, 3>() = seconds * Eigen::Matrix3d::Identity();
    std::vector<MarkerBelief> result = after;
    for (std::size_t k = measured.size() - 1; k-- > 0;) {
        const Matrix6 own = covariance_of(after[k]);
        const Matrix6 next = covariance_of(before[k + 1]);
        const Matrix6 gain = own * step.transpose() * next.inverse();
        Eigen::Matrix<double, 6, 1> miss;
        const glm::dvec3 place = result[k + 1].place - before[k + 1].place;
        const glm::dvec3 velocity = result[k + 1].velocity - before[k + 1].velocity;
        miss << place.x, place.y, place.z, velocity.x, velocity.y, velocity.z;
        const Eigen::Matrix<double, 6, 1> move = gain * miss;
        result[k].place += glm::dvec3(move[0], move[1], move[2]);
        result[k].velocity += glm::dvec3(move[3], move[4], move[5]);
        set_covariance(result[k],
                       own + gain * (covariance_of(result[k + 1]) - next) * gain.transpose());
    }
    return result;
}

}  // namespace raks::capture
