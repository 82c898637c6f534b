#include "motion/capture/solving/size_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "motion/capture/solving/frame_fit.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;
using motion::Side;

constexpr int kRounds = 8;
constexpr double kSteady = 100.0;  // 1 / (0.1)^2: no step of a posture beyond some 0.1
// Parameters: whole, parts, then three of each marker, then single bones where these are fitted.
constexpr std::size_t kWhole = 0;
constexpr std::size_t kFirstPart = 1;
constexpr std::size_t kFirstMarker = kFirstPart + kBodyParts;
// A model is never quite the body.
constexpr double kModelErrorMetres = 0.01;
constexpr double kRepeatedErrorFactor = 1.5;

/// How a point moves with the parameters of the size.
struct SizeMotion {
    std::vector<std::size_t> parameters;
    std::vector<glm::dvec3> moves;

    void add(std::size_t parameter, const glm::dvec3& move) {
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            if (parameters[i] == parameter) {
                moves[i] += move;
                return;
            }
        }
        parameters.push_back(parameter);
        moves.push_back(move);
    }
};

/// Of a point of a bone at `arm` (world axes) from the bone's joint, which grows with the bone.
/// `first_bone`: parameter of the first single bone; none: they are not fitted.
SizeMotion size_motion(std::optional<std::size_t> first_bone,
                       const BodyShape& shape,
                       const PlacedBody& body,
                       Bone bone,
                       const glm::dvec3& arm) {
    SizeMotion motion;
    const auto grows = [&](BodyPart part, const glm::dvec3& by) {
        motion.add(kFirstPart + static_cast<std::size_t>(part), by);
        motion.add(kWhole, by);
    };
    grows(part_of(bone), arm);
    for (std::size_t i = index_of(bone); i != 0; i = motion::kBoneParents[i]) {
        const glm::dvec3 bone_before = body.frames[motion::kBoneParents[i]] * shape.offsets[i];
        grows(part_before(static_cast<Bone>(i)), bone_before);
        if (first_bone) {
            motion.add(*first_bone + i, bone_before);
        }
    }
    return motion;
}

/// The equations of all frames with the postures eliminated.
class SizeSystem {
 public:
    SizeSystem(std::size_t variables, std::size_t parameters)
        : variables_(static_cast<Eigen::Index>(variables)),
          parameters_(static_cast<Eigen::Index>(parameters)),
          matrix(Eigen::MatrixXd::Zero(parameters_, parameters_)),
          gradient(Eigen::VectorXd::Zero(parameters_)) {
        mixed_.setZero(variables_, parameters_);
    }

    /// A point's difference, weighted by axis (1 / variance).
    void add(const PointMotion& pose,
             const SizeMotion& size,
             const glm::dvec3& difference,
             const glm::dvec3& weight) {
        for (std::size_t k = 0; k < size.parameters.size(); ++k) {
            const glm::dvec3 weighted = weight * size.moves[k];
            const auto column = static_cast<Eigen::Index>(size.parameters[k]);
            gradient(column) += glm::dot(weighted, difference);
            for (std::size_t i = 0; i < pose.count; ++i) {
                mixed_(static_cast<Eigen::Index>(pose.variables[i]), column) +=
                    glm::dot(weighted, pose.moves[i]);
            }
            for (std::size_t i = 0; i < size.parameters.size(); ++i) {
                matrix(static_cast<Eigen::Index>(size.parameters[i]), column) +=
                    glm::dot(weighted, size.moves[i]);
            }
        }
    }

    /// Ends a frame: its posture follows the size. Keeps what take_steps needs.
    void eliminate(FrameSystem& frame) {
        frame.matrix.diagonal().array() += kSteady;
        const Eigen::LLT<Eigen::MatrixXd> factor(frame.matrix);
        const Eigen::MatrixXd follows = factor.solve(mixed_);
        const Eigen::VectorXd alone = factor.solve(frame.gradient);
        matrix.noalias() -= mixed_.transpose() * follows;
        gradient.noalias() -= mixed_.transpose() * alone;
        follows_.push_back(follows);
        alone_.push_back(alone);
        mixed_.setZero();
    }

    /// The step of a frame's posture when the size makes this one.
    [[nodiscard]] Eigen::VectorXd posture_step(std::size_t frame,
                                               const Eigen::VectorXd& size_step) const {
        return -alone_[frame] - follows_[frame] * size_step;
    }

 private:
    Eigen::Index variables_;
    Eigen::Index parameters_;
    Eigen::MatrixXd mixed_;
    std::vector<Eigen::MatrixXd> follows_;
    std::vector<Eigen::VectorXd> alone_;

 public:
    Eigen::MatrixXd matrix;    ///< of the parameters
    Eigen::VectorXd gradient;  ///< of the parameters
};

void add_frame(const FrameContext& context,
               const BodySize& size,
               const BodyState& state,
               const FrameSight& sight,
               std::optional<std::size_t> first_bone,
               FrameSystem& frame,
               SizeSystem& system) {
    const BodyModel& model = context.model;
    const BodyShape& shape = context.shape;
    const PlacedBody body = model.place(shape, state);
    frame.clear(model.variables());
    add_frame_terms(context, state, body, sight, frame);
    for (const SeenMarker& seen : sight.markers) {
        const Bone bone = context.marker_bones[seen.marker];
        const glm::dvec3 arm = body.frames[index_of(bone)] * shape.marker_places[seen.marker];
        const glm::dvec3 point = body.places[index_of(bone)] + arm;
        const glm::dvec3 difference = point - seen.place;
        const glm::dvec3 shift = body.frames[index_of(bone)] * size.marker_shifts[seen.marker];
        SizeMotion moves = size_motion(first_bone, shape, body, bone, arm - shift);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            moves.add(kFirstMarker + 3 * seen.marker + static_cast<std::size_t>(axis),
                      body.frames[index_of(bone)][axis]);
        }
        const double weight =
            marker_trust(difference, context.weights.outlier) / (seen.deviation * seen.deviation);
        system.add(model.motion_of(body, bone, point), moves, difference, glm::dvec3(weight));
    }
    for (const Side side : motion::kSides) {
        for (std::size_t i = 0; i < kSolePoints; ++i) {
            const auto which = static_cast<SolePoint>(i);
            const Bone bone = sole_bone(side, which);
            const glm::dvec3 arm = body.frames[index_of(bone)] * shape.sole_point(side, which);
            const glm::dvec3 point = body.places[index_of(bone)] + arm;
            const double weight =
                sole_weight(sight.planted[static_cast<std::size_t>(side)][i], point.y);
            if (weight > 0.0) {
                system.add(model.motion_of(body, bone, point),
                           size_motion(first_bone, shape, body, bone, arm),
                           {0.0, point.y, 0.0},
                           {0.0, weight, 0.0});
            }
        }
    }
    system.eliminate(frame);
}

void add_prior(const SizePrior& prior,
               const BodySize& size,
               const std::array<double, motion::kBoneCount>& usual_bones,
               std::optional<std::size_t> first_bone,
               SizeSystem& system) {
    const auto add = [&](std::size_t parameter, double from_usual, double deviation) {
        const auto at = static_cast<Eigen::Index>(parameter);
        const double weight = 1.0 / (deviation * deviation);
        system.matrix(at, at) += weight;
        system.gradient(at) += weight * from_usual;
    };
    add(kWhole, std::log(size.whole / prior.whole), prior.whole_deviation);
    for (std::size_t i = 0; i < kBodyParts; ++i) {
        add(kFirstPart + i, std::log(size.parts[i]), prior.part_deviation);
    }
    for (std::size_t i = 0; first_bone && i < usual_bones.size(); ++i) {
        add(*first_bone + i, std::log(size.bones[i] / usual_bones[i]), prior.bone_deviation);
    }
    for (std::size_t i = 0; i < size.marker_shifts.size(); ++i) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            add(kFirstMarker + 3 * i + static_cast<std::size_t>(axis),
                size.marker_shifts[i][axis],
                prior.marker_deviation);
        }
    }
}

void move_size(const Eigen::VectorXd& step, std::optional<std::size_t> first_bone, BodySize& size) {
    const auto at = [&step](std::size_t parameter) {
        return step(static_cast<Eigen::Index>(parameter));
    };
    size.whole *= std::exp(at(kWhole));
    for (std::size_t i = 0; i < kBodyParts; ++i) {
        size.parts[i] *= std::exp(at(kFirstPart + i));
    }
    for (std::size_t i = 0; first_bone && i < size.bones.size(); ++i) {
        size.bones[i] *= std::exp(at(*first_bone + i));
    }
    for (std::size_t i = 0; i < size.marker_shifts.size(); ++i) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            size.marker_shifts[i][axis] +=
                at(kFirstMarker + 3 * i + static_cast<std::size_t>(axis));
        }
    }
}

}  // namespace

FrameSight sight_for_size(FrameSight sight) {
    for (SeenMarker& seen : sight.markers) {
        seen.deviation = kRepeatedErrorFactor * std::hypot(seen.deviation, kModelErrorMetres);
    }
    return sight;
}

double guess_size(const BodyModel& model,
                  const MarkerSet& markers,
                  const std::vector<FrameSight>& sights) {
    const BodyShape shape = shape_of(BodySize{}, markers);
    const PlacedBody body = model.place(shape, model.usual_state(shape));
    double measured = 0.0;
    double usual = 0.0;
    for (const FrameSight& sight : sights) {
        for (const SeenMarker& one : sight.markers) {
            const Bone bone = markers.markers[one.marker].bone;
            for (const SeenMarker& other : sight.markers) {
                const Bone other_bone = markers.markers[other.marker].bone;
                if (other.marker > one.marker && is_of_trunk(bone) && is_of_trunk(other_bone)) {
                    measured += glm::distance(one.place, other.place);
                    usual +=
                        glm::distance(body.point(bone, shape.marker_places[one.marker]),
                                      body.point(other_bone, shape.marker_places[other.marker]));
                }
            }
        }
    }
    return usual > 0.0 ? measured / usual : 1.0;
}

BodySize fit_size(const BodyModel& model,
                  const MarkerSet& markers,
                  const SizePrior& prior,
                  const FrameWeights& weights,
                  const std::vector<FrameSight>& sights,
                  BodySize size,
                  std::vector<BodyState>& states) {
    size.marker_shifts.resize(markers.markers.size());
    const auto usual_bones = size.bones;
    std::vector<Bone> bones;
    for (const Marker& marker : markers.markers) {
        bones.push_back(marker.bone);
    }
    std::size_t parameters = kFirstMarker + 3 * markers.markers.size();
    std::optional<std::size_t> first_bone;
    if (prior.bone_deviation > 0.0) {
        first_bone = parameters;
        parameters += motion::kBoneCount;
    }
    FrameSystem frame;
    for (int round = 0; round < kRounds; ++round) {
        const BodyShape shape = shape_of(size, markers);
        const FrameContext context{model, bones, shape, weights};
        SizeSystem system(model.variables(), parameters);
        for (std::size_t i = 0; i < sights.size(); ++i) {
            add_frame(context, size, states[i], sights[i], first_bone, frame, system);
        }
        add_prior(prior, size, usual_bones, first_bone, system);
        const Eigen::VectorXd step = system.matrix.ldlt().solve(-system.gradient);
        if (!step.allFinite()) {
            break;
        }
        move_size(step, first_bone, size);
        for (std::size_t i = 0; i < states.size(); ++i) {
            const Eigen::VectorXd change = system.posture_step(i, step);
            states[i] = model.moved(states[i], change.data());
        }
        if (step.lpNorm<Eigen::Infinity>() < 1e-5) {
            break;
        }
    }
    return size;
}

}  // namespace raks::capture
