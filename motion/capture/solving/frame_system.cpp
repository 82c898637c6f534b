#include "motion/capture/solving/frame_system.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Side;

constexpr double kLimitDeviation = 0.05;   // radians beyond a joint's limit
constexpr double kFloorDeviation = 0.002;  // metres under the floor
constexpr double kSoleDeviation = 0.008;   // metres of a planted sole from the floor

/// Cost of a term with this residual and weight.
double cost_of(double residual, double weight) { return 0.5 * weight * residual * residual; }

double add_markers(const FrameContext& context,
                   const PlacedBody& body,
                   const FrameSight& sight,
                   FrameSystem& system) {
    double cost = 0.0;
    const double outlier = context.weights.outlier;
    for (const SeenMarker& seen : sight.markers) {
        const motion::Bone bone = context.marker_bones[seen.marker];
        const glm::dvec3 point = body.point(bone, context.shape.marker_places[seen.marker]);
        const glm::dvec3 difference = point - seen.place;
        const double trust = marker_trust(difference, outlier);
        const double worth = 1.0 / (seen.deviation * seen.deviation);
        system.add(
            context.model.motion_of(body, bone, point), difference, glm::dvec3(trust * worth));
        const double square = glm::dot(difference, difference) / (outlier * outlier);
        cost += 0.5 * worth * outlier * outlier * std::log1p(square);  // Cauchy
    }
    return cost;
}

double add_hinge(const TurningJoint& joint, double angle, double usual, FrameSystem& system) {
    const auto at = static_cast<Eigen::Index>(joint.first);
    const auto add = [&](double residual, double weight) {
        system.matrix(at, at) += weight;
        system.gradient(at) += weight * residual;
        return cost_of(residual, weight);
    };
    double cost = add(angle - joint.usual_angle, usual / (joint.deviation.x * joint.deviation.x));
    const double beyond = angle - std::clamp(angle, joint.lowest, joint.highest);
    if (beyond != 0.0) {
        cost += add(beyond, 1.0 / (kLimitDeviation * kLimitDeviation));
    }
    return cost;
}

double add_ball(const TurningJoint& joint,
                const glm::dquat& turn,
                double usual,
                FrameSystem& system) {
    // Bones that turn alike are usually unturned.
    const auto count = static_cast<double>(joint.count);
    const glm::dvec3 share =
        turn_vector(joint.count == 1 ? glm::conjugate(joint.usual) * turn : turn);
    const glm::dvec3 from_usual = count * share;
    const glm::dmat3 change = turn_vector_change(share);
    double cost = 0.0;
    const auto add = [&](const glm::dvec3& row, double residual, double weight) {
        for (glm::length_t i = 0; i < 3; ++i) {
            const auto at = static_cast<Eigen::Index>(joint.first) + i;
            system.gradient(at) += weight * row[i] * residual;
            for (glm::length_t k = 0; k < 3; ++k) {
                system.matrix(at, static_cast<Eigen::Index>(joint.first) + k) +=
                    weight * row[i] * row[k];
            }
        }
        cost += cost_of(residual, weight);
    };
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double deviation = joint.deviation[axis];
        add({change[0][axis], change[1][axis], change[2][axis]},
            from_usual[axis],
            usual / (deviation * deviation));
    }
    const double angle = glm::length(from_usual);
    if (angle > joint.highest) {
        add(from_usual / angle, angle - joint.highest, 1.0 / (kLimitDeviation * kLimitDeviation));
    }
    return cost;
}

double add_floor(const FrameContext& context,
                 const PlacedBody& body,
                 const FrameSight& sight,
                 FrameSystem& system) {
    double cost = 0.0;
    for (const Side side : motion::kSides) {
        for (std::size_t i = 0; i < kSolePoints; ++i) {
            const auto which = static_cast<SolePoint>(i);
            const motion::Bone bone = sole_bone(side, which);
            const glm::dvec3 point = body.point(bone, context.shape.sole_point(side, which));
            const double planted = sight.planted[static_cast<std::size_t>(side)][i];
            const double weight = sole_weight(planted, point.y);
            if (weight > 0.0) {
                system.add(context.model.motion_of(body, bone, point),
                           {0.0, point.y, 0.0},
                           {0.0, weight, 0.0});
                cost += cost_of(point.y, weight);
            }
        }
    }
    return cost;
}

}  // namespace

void FrameSystem::clear(std::size_t variables) {
    const auto size = static_cast<Eigen::Index>(variables);
    matrix.setZero(size, size);
    gradient.setZero(size);
}

void FrameSystem::add(const PointMotion& motion,
                      const glm::dvec3& difference,
                      const glm::dvec3& weight) {
    for (std::size_t i = 0; i < motion.count; ++i) {
        const glm::dvec3 weighted = weight * motion.moves[i];
        const auto row = static_cast<Eigen::Index>(motion.variables[i]);
        gradient(row) += glm::dot(weighted, difference);
        for (std::size_t k = 0; k < motion.count; ++k) {
            matrix(static_cast<Eigen::Index>(motion.variables[k]), row) +=
                glm::dot(weighted, motion.moves[k]);
        }
    }
}

void FrameSystem::add(const PointMotion& motion, const glm::dvec3& pull, const glm::dmat3& weight) {
    for (std::size_t i = 0; i < motion.count; ++i) {
        const glm::dvec3 weighted = weight * motion.moves[i];
        const auto row = static_cast<Eigen::Index>(motion.variables[i]);
        gradient(row) += glm::dot(pull, motion.moves[i]);
        for (std::size_t k = 0; k < motion.count; ++k) {
            matrix(static_cast<Eigen::Index>(motion.variables[k]), row) +=
                glm::dot(weighted, motion.moves[k]);
        }
    }
}

double marker_trust(const glm::dvec3& difference, double outlier) noexcept {
    return 1.0 / (1.0 + glm::dot(difference, difference) / (outlier * outlier));
}

double sole_weight(double planted, double height) noexcept {
    const double on = planted / (kSoleDeviation * kSoleDeviation);
    return height < 0.0 ? on + 1.0 / (kFloorDeviation * kFloorDeviation) : on;
}

double add_joint_terms(const FrameContext& context, const BodyState& state, FrameSystem& system) {
    double cost = 0.0;
    const auto& joints = context.model.joints();
    for (std::size_t i = 1; i < joints.size(); ++i) {  // the hips turn as they like
        cost += joints[i].is_hinge
                    ? add_hinge(joints[i], state.angles[i], context.weights.usual, system)
                    : add_ball(joints[i], state.turns[i], context.weights.usual, system);
    }
    return cost;
}

double add_frame_terms(const FrameContext& context,
                       const BodyState& state,
                       const PlacedBody& body,
                       const FrameSight& sight,
                       FrameSystem& system) {
    return add_markers(context, body, sight, system) + add_joint_terms(context, state, system) +
           add_floor(context, body, sight, system);
}

}  // namespace raks::capture
