#include "motion/capture/solving/frame_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;
using motion::Side;

constexpr int kFirstSteps = 30;          // from nothing
constexpr int kFollowSteps = 6;          // from the frame before
constexpr double kBadDifference = 0.06;  // metres, median: look for the body anew

struct RigidFit {
    glm::dquat turn;
    glm::dvec3 from{};  // middle of the places on the body
    glm::dvec3 to{};    // middle of the places that were measured
};

Eigen::Vector3d eigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Where the markers of the trunk have gone (Kabsch).
std::optional<RigidFit> fit_trunk(const FrameContext& context,
                                  const PlacedBody& body,
                                  const FrameSight& sight) {
    std::vector<std::pair<glm::dvec3, glm::dvec3>> pairs;
    RigidFit fit;
    for (const SeenMarker& seen : sight.markers) {
        const Bone bone = context.marker_bones[seen.marker];
        if (is_of_trunk(bone)) {
            pairs.emplace_back(body.point(bone, context.shape.marker_places[seen.marker]),
                               seen.place);
            fit.from += pairs.back().first;
            fit.to += pairs.back().second;
        }
    }
    if (pairs.size() < 3) {
        return std::nullopt;
    }
    fit.from /= static_cast<double>(pairs.size());
    fit.to /= static_cast<double>(pairs.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& [from, to] : pairs) {
        covariance += eigen(from - fit.from) * eigen(to - fit.to).transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d turn = svd.matrixV() * svd.matrixU().transpose();
    if (turn.determinant() < 0.0) {
        Eigen::Matrix3d v = svd.matrixV();
        v.col(2) *= -1.0;
        turn = v * svd.matrixU().transpose();
    }
    glm::dmat3 columns(1.0);
    for (glm::length_t c = 0; c < 3; ++c) {
        for (glm::length_t r = 0; r < 3; ++r) {
            columns[c][r] = turn(r, c);
        }
    }
    fit.turn = glm::quat_cast(columns);
    return fit;
}

/// Arms from which a fit may start: turns of the upper arm out of the T-pose (on the left), and
/// the bend of the elbow.
struct ArmStart {
    glm::dvec3 turn;
    double bend;
};
constexpr std::array<ArmStart, 5> kArmStarts = {{
    {{0.0, 0.0, -1.2}, 0.5},   // down
    {{0.0, -1.0, -0.6}, 1.5},  // before the body
    {{0.0, 0.0, 0.0}, 0.5},    // out
    {{0.0, 0.0, 1.0}, 0.5},    // up
    {{1.5, -0.8, 0.5}, 1.8},   // hand at the head
}};

void set_arms(const BodyModel& model, const ArmStart& arms, BodyState& state) {
    for (std::size_t i = 0; i < model.joints().size(); ++i) {
        const TurningJoint& joint = model.joints()[i];
        for (const Side side : motion::kSides) {
            const double out = side == Side::left ? 1.0 : -1.0;
            if (joint.bones[0] == on_side(Bone::left_upper_arm, side)) {
                state.turns[i] = turned_by({arms.turn.x, out * arms.turn.y, out * arms.turn.z});
            } else if (joint.bones[0] == on_side(Bone::left_lower_arm, side) &&
                       joint.axis.y != 0.0) {
                state.angles[i] = arms.bend;
            }
        }
    }
}

/// Median distance of the markers from where they were measured, metres.
double median_difference(const FrameContext& context,
                         const BodyState& state,
                         const FrameSight& sight) {
    if (sight.markers.empty()) {
        return 0.0;
    }
    const PlacedBody body = context.model.place(context.shape, state);
    std::vector<double> distances;
    for (const SeenMarker& seen : sight.markers) {
        const glm::dvec3 point =
            body.point(context.marker_bones[seen.marker], context.shape.marker_places[seen.marker]);
        distances.push_back(glm::distance(point, seen.place));
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

}  // namespace

bool is_of_trunk(Bone bone) noexcept {
    return bone <= Bone::upper_chest || bone == Bone::left_shoulder || bone == Bone::right_shoulder;
}

FittedFrame fit_frame(const FrameContext& context,
                      const FrameSight& sight,
                      const BodyState& start,
                      int most_steps) {
    const std::size_t variables = context.model.variables();
    FrameSystem system;
    FrameSystem tried;
    const auto assess = [&](const BodyState& state, FrameSystem& into) {
        into.clear(variables);
        return add_frame_terms(
            context, state, context.model.place(context.shape, state), sight, into);
    };
    FittedFrame best{start, 0.0};
    best.cost = assess(start, system);
    double damping = 1.0;
    for (int step = 0; step < most_steps; ++step) {
        Eigen::MatrixXd damped = system.matrix;
        damped.diagonal().array() += damping;
        const Eigen::VectorXd change = damped.llt().solve(-system.gradient);
        if (!change.allFinite()) {
            break;
        }
        const BodyState next = context.model.moved(best.state, change.data());
        const double cost = assess(next, tried);
        if (cost < best.cost) {
            const bool is_settled = best.cost - cost < 1e-4 * best.cost;
            best = {next, cost};
            std::swap(system, tried);
            damping = std::max(1e-3, damping * 0.2);
            if (is_settled) {
                break;
            }
        } else {
            damping *= 10.0;
        }
    }
    return best;
}

FittedFrame find_frame(const FrameContext& context,
                       const FrameSight& sight,
                       const BodyState& otherwise) {
    BodyState start = context.model.usual_state(context.shape);
    const auto trunk = fit_trunk(context, context.model.place(context.shape, start), sight);
    start.turns[0] = trunk ? trunk->turn : otherwise.turns[0];
    start.hips = trunk ? trunk->to + trunk->turn * (start.hips - trunk->from) : otherwise.hips;
    std::optional<FittedFrame> best;
    FrameContext wide = context;
    wide.weights.outlier = 0.3;  // limbs may be far off
    for (const ArmStart& arms : kArmStarts) {
        set_arms(context.model, arms, start);
        const FittedFrame near = fit_frame(wide, sight, start, kFirstSteps);
        const FittedFrame fitted = fit_frame(context, sight, near.state, kFirstSteps);
        if (!best || fitted.cost < best->cost) {
            best = fitted;
        }
    }
    return *best;
}

std::vector<BodyState> fit_frames(const FrameContext& context,
                                  const std::vector<FrameSight>& sights) {
    const auto best = std::max_element(
        sights.begin(), sights.end(), [](const FrameSight& one, const FrameSight& other) {
            return one.markers.size() < other.markers.size();
        });
    const auto first = static_cast<std::size_t>(best - sights.begin());
    std::vector<BodyState> states(sights.size());
    const auto follow = [&](std::size_t frame, const BodyState& before) {
        FittedFrame fitted = fit_frame(context, sights[frame], before, kFollowSteps);
        if (median_difference(context, fitted.state, sights[frame]) > kBadDifference) {
            const FittedFrame anew = find_frame(context, sights[frame], before);
            if (anew.cost < fitted.cost) {
                fitted = anew;
            }
        }
        states[frame] = fitted.state;
    };
    states[first] =
        find_frame(context, sights[first], context.model.usual_state(context.shape)).state;
    for (std::size_t frame = first + 1; frame < sights.size(); ++frame) {
        follow(frame, states[frame - 1]);
    }
    for (std::size_t frame = first; frame-- > 0;) {
        follow(frame, states[frame + 1]);
    }
    return states;
}

}  // namespace raks::capture
