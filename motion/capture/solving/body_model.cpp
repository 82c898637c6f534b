#include "motion/capture/solving/body_model.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/assert.hpp"
#include "motion/choreography/joint_limits.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;
using motion::Side;

constexpr double kDegree = M_PI / 180.0;
constexpr double kFree = 1e3;  // radians: no limit, no usual turn
// Of an upper arm from where it is usually: in salsa it turns by up to 157 degrees.
constexpr double kShoulderLimit = 160.0 * kDegree;

// Accelerations of joints in danced salsa, radians / s^2 at 60 frames a second: what the motion
// prior allows. Root mean squares of takes at 164 BPM are some half of these.
constexpr double kHipsAcceleration = 40.0;
constexpr double kTrunkAcceleration = 40.0;
constexpr double kNeckAcceleration = 40.0;
constexpr double kArmAcceleration = 80.0;
constexpr double kForearmAcceleration = 80.0;
constexpr double kLegAcceleration = 60.0;
constexpr double kKneeAcceleration = 100.0;
constexpr double kFootAcceleration = 80.0;

double highest_of(std::string_view joint) {
    for (const motion::JointLimit& limit : motion::joint_limits()) {
        if (limit.joint == joint) {
            return limit.highest * kDegree;
        }
    }
    return kFree;
}

TurningJoint ball(std::initializer_list<Bone> bones,
                  const glm::dvec3& deviation,
                  double highest,
                  double acceleration) {
    TurningJoint joint;
    std::copy(bones.begin(), bones.end(), joint.bones.begin());
    joint.count = bones.size();
    joint.deviation = deviation;
    joint.highest = highest;
    joint.acceleration = acceleration;
    return joint;
}

TurningJoint hinge(Bone bone,
                   const glm::dvec3& axis,
                   double usual,
                   double deviation,
                   double lowest,
                   double highest,
                   double acceleration) {
    TurningJoint joint;
    joint.bones[0] = bone;
    joint.is_hinge = true;
    joint.axis = axis;
    joint.usual_angle = usual;
    joint.deviation = glm::dvec3(deviation, 0.0, 0.0);
    joint.lowest = lowest;
    joint.highest = highest;
    joint.acceleration = acceleration;
    return joint;
}

}  // namespace

glm::dquat turned_by(const glm::dvec3& turn) noexcept {
    const double angle = glm::length(turn);
    const double half = 0.5 * angle;
    // sin(angle / 2) / angle, by its series near 0.
    const double factor = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
    return {std::cos(half), factor * turn.x, factor * turn.y, factor * turn.z};
}

glm::dvec3 turn_vector(const glm::dquat& rotation) noexcept {
    const double sign = rotation.w < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 axis = sign * glm::dvec3(rotation.x, rotation.y, rotation.z);
    const double sine = glm::length(axis);
    if (sine < 1e-9) {
        return 2.0 * axis;
    }
    return (2.0 * std::atan2(sine, sign * rotation.w) / sine) * axis;
}

glm::dmat3 turn_vector_change(const glm::dvec3& turn) noexcept {
    const double angle = glm::length(turn);
    const double factor =
        angle < 1e-3 ? 1.0 / 12.0 : 1.0 / (angle * angle) - 0.5 / (angle * std::tan(0.5 * angle));
    const glm::dmat3 cross(
        0.0, turn.z, -turn.y, -turn.z, 0.0, turn.x, turn.y, -turn.x, 0.0);  // by columns
    return glm::dmat3(1.0) + 0.5 * cross + factor * cross * cross;
}

BodyModel::BodyModel(BodyKind kind) {
    add_trunk(kind);
    for (const Side side : motion::kSides) {
        add_side(kind, side);
    }
    find_parts_of_bones();
}

BodyModel::BodyModel(std::vector<TurningJoint> joints) {
    for (TurningJoint& joint : joints) {
        add(std::move(joint));
    }
    find_parts_of_bones();
}

void BodyModel::find_parts_of_bones() {
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        own_parts_[index_of(parts_[part].bone)].push_back(part);
    }
    for (std::size_t bone = 0; bone < moving_parts_.size(); ++bone) {
        if (bone != 0) {
            moving_parts_[bone] = moving_parts_[motion::kBoneParents[bone]];
        }
        moving_parts_[bone].insert(
            moving_parts_[bone].end(), own_parts_[bone].begin(), own_parts_[bone].end());
    }
}

void BodyModel::add(TurningJoint joint) {
    if (joint.name.empty()) {
        // A joint of its own for a turn along the bone that another one bends.
        joint.name = motion::kBoneNames[index_of(joint.bones[0])];
        joint.name += has_joint(joint.name) ? "Twist" : "";
    }
    joint.first = variables_;
    variables_ += joint.size();
    for (std::size_t i = 0; i < joint.count; ++i) {
        parts_.push_back({joints_.size(), joint.bones[i]});
    }
    joints_.push_back(joint);
    RAKS_ASSERT(joints_.size() <= kMostJoints && variables_ <= kMostVariables);
}

bool BodyModel::has_joint(std::string_view name) const noexcept {
    return std::any_of(joints_.begin(), joints_.end(), [name](const TurningJoint& joint) {
        return joint.name == name;
    });
}

void BodyModel::add_trunk(BodyKind kind) {
    add(ball({Bone::hips}, glm::dvec3(kFree), kFree, kHipsAcceleration));
    if (kind == BodyKind::paper) {
        return;
    }
    // Two joints, so that the chest may slide over the hips; their limits add up to the trunk's.
    add(ball({Bone::spine}, glm::dvec3(0.25), 0.5 * highest_of("trunk"), kTrunkAcceleration));
    add(ball({Bone::chest, Bone::upper_chest},
             glm::dvec3(0.25),
             0.5 * highest_of("trunk"),
             kTrunkAcceleration));
    // A single marker on the head says nothing of its turn about the neck.
    add(ball({Bone::neck, Bone::head},
             glm::dvec3(0.3, 0.15, 0.3),
             highest_of("neck"),
             kNeckAcceleration));
}

void BodyModel::add_side(BodyKind kind, Side side) {
    const double out = side == Side::left ? 1.0 : -1.0;
    const bool dances = kind == BodyKind::dance;
    const auto bone = [side](Bone left) { return motion::on_side(left, side); };
    if (dances) {
        add(ball({bone(Bone::left_shoulder)},
                 glm::dvec3(0.05, 0.12, 0.12),
                 highest_of("left collarbone"),
                 kTrunkAcceleration));
    }
    TurningJoint arm =
        ball({bone(Bone::left_upper_arm)}, glm::dvec3(1.2), kShoulderLimit, kArmAcceleration);
    arm.usual = turned_by({0.0, 0.0, -0.9 * out});  // half-way down
    add(arm);
    // In the T-pose the elbow brings the hand forward, the knee the heel back.
    const double elbow = highest_of("left elbow");
    add(hinge(
        bone(Bone::left_lower_arm), {0.0, -out, 0.0}, 0.9, 1.5, 0.0, elbow, kForearmAcceleration));
    if (dances) {
        add(hinge(bone(Bone::left_lower_arm),
                  {out, 0.0, 0.0},
                  0.0,
                  0.6,
                  -1.6,
                  1.6,
                  kForearmAcceleration));
        add(ball({bone(Bone::left_hand)},
                 glm::dvec3(0.6, 0.35, 0.35),
                 highest_of("left wrist"),
                 kForearmAcceleration));
    }
    add(ball(
        {bone(Bone::left_upper_leg)}, glm::dvec3(0.8), highest_of("left hip"), kLegAcceleration));
    const double knee = highest_of("left knee");
    add(hinge(bone(Bone::left_lower_leg),
              {1.0, 0.0, 0.0},
              0.3,
              1.0,
              3.0 * kDegree,
              knee,
              kKneeAcceleration));
    if (dances) {
        add(ball({bone(Bone::left_foot)},
                 glm::dvec3(0.4, 0.25, 0.2),
                 highest_of("left ankle"),
                 kFootAcceleration));
        add(hinge(bone(Bone::left_toes),
                  {1.0, 0.0, 0.0},
                  0.0,
                  0.1,
                  -60.0 * kDegree,
                  30.0 * kDegree,
                  kFootAcceleration));
    }
}

std::size_t BodyModel::parent_of(std::size_t joint) const noexcept {
    std::size_t before = 0;
    for (const std::size_t part : moving_parts_[index_of(joints_[joint].bones[0])]) {
        if (parts_[part].joint == joint) {
            break;
        }
        before = parts_[part].joint;
    }
    return before;
}

BodyState BodyModel::usual_state(const BodyShape& shape) const {
    BodyState state;
    state.hips = shape.offsets[0];
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const TurningJoint& joint = joints_[i];
        state.turns[i] = turned_by(turn_vector(joint.usual) / static_cast<double>(joint.count));
        state.angles[i] = joint.usual_angle;
    }
    return state;
}

BodyState BodyModel::moved(const BodyState& state, const double* change) const {
    BodyState next = state;
    next.hips += glm::dvec3(change[0], change[1], change[2]);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const TurningJoint& joint = joints_[i];
        const double* by = change + joint.first;
        if (joint.is_hinge) {
            next.angles[i] += by[0];
        } else {
            const double share = 1.0 / static_cast<double>(joint.count);
            next.turns[i] =
                glm::normalize(next.turns[i] * turned_by(share * glm::dvec3(by[0], by[1], by[2])));
        }
    }
    return next;
}

glm::dquat BodyModel::local_turn(const BodyState& state, std::size_t joint) const {
    return joints_[joint].is_hinge ? turned_by(state.angles[joint] * joints_[joint].axis)
                                   : state.turns[joint];
}

PlacedBody BodyModel::place(const BodyShape& shape, const BodyState& state) const {
    PlacedBody body;
    for (std::size_t bone = 0; bone < motion::kBoneCount; ++bone) {
        const std::size_t parent = motion::kBoneParents[bone];
        glm::dmat3 frame = bone == 0 ? glm::dmat3(1.0) : body.frames[parent];
        body.places[bone] =
            bone == 0 ? state.hips : body.places[parent] + frame * shape.offsets[bone];
        for (const std::size_t part : own_parts_[bone]) {
            frame = frame * glm::mat3_cast(local_turn(state, parts_[part].joint));
            body.part_frames[part] = frame;
        }
        body.frames[bone] = frame;
    }
    return body;
}

PointMotion BodyModel::motion_of(const PlacedBody& body, Bone bone, const glm::dvec3& point) const {
    PointMotion motion;
    for (std::size_t i = 0; i < 3; ++i) {
        motion.variables[i] = i;
        motion.moves[i] = glm::dvec3(0.0);
        motion.moves[i][static_cast<glm::length_t>(i)] = 1.0;
    }
    motion.count = 3;
    std::size_t before = kMostJoints;
    for (const std::size_t index : moving_parts_[index_of(bone)]) {
        const Part& part = parts_[index];
        const TurningJoint& joint = joints_[part.joint];
        const glm::dvec3 arm = point - body.places[index_of(part.bone)];
        const glm::dmat3& frame = body.part_frames[index];
        const double share = 1.0 / static_cast<double>(joint.count);
        if (part.joint != before) {  // bones of one joint follow one another
            for (std::size_t k = 0; k < joint.size(); ++k) {
                motion.variables[motion.count + k] = joint.first + k;
                motion.moves[motion.count + k] = glm::dvec3(0.0);
            }
            motion.count += joint.size();
            before = part.joint;
        }
        const std::size_t first = motion.count - joint.size();
        if (joint.is_hinge) {
            motion.moves[first] += glm::cross(frame * joint.axis, arm);
        } else {
            for (glm::length_t k = 0; k < 3; ++k) {
                motion.moves[first + static_cast<std::size_t>(k)] +=
                    share * glm::cross(frame[k], arm);
            }
        }
    }
    return motion;
}

glm::dvec3 BodyModel::turn_of(const BodyState& state, std::size_t joint) const {
    if (joints_[joint].is_hinge) {
        return {state.angles[joint], 0.0, 0.0};
    }
    return static_cast<double>(joints_[joint].count) * turn_vector(state.turns[joint]);
}

double BodyModel::from_usual(const BodyState& state, std::size_t joint) const {
    const TurningJoint& turning = joints_[joint];
    if (turning.is_hinge) {
        return state.angles[joint];
    }
    return turning.count == 1
               ? glm::length(turn_vector(glm::conjugate(turning.usual) * state.turns[joint]))
               : glm::length(turn_of(state, joint));
}

BodyModel BodyModel::without_limits() const {
    BodyModel model = *this;
    for (TurningJoint& joint : model.joints_) {
        joint.lowest = -kFree;
        joint.highest = kFree;
    }
    return model;
}

motion::Pose BodyModel::pose_of(const BodyState& state) const {
    std::array<glm::dquat, motion::kBoneCount> local{};
    for (std::size_t bone = 0; bone < local.size(); ++bone) {
        local[bone] = glm::dquat(1.0, 0.0, 0.0, 0.0);
        for (const std::size_t part : own_parts_[bone]) {
            local[bone] = local[bone] * local_turn(state, parts_[part].joint);
        }
    }
    motion::Pose pose;
    pose.hips_position = glm::vec3(state.hips);
    for (std::size_t bone = 0; bone < local.size(); ++bone) {
        pose.local_rotations[bone] = glm::quat(glm::normalize(local[bone]));
    }
    return pose;
}

BodyState BodyModel::between(const BodyState& from, const BodyState& to, double share) const {
    BodyState state = from;
    state.hips += share * (to.hips - from.hips);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        state.angles[i] += share * (to.angles[i] - from.angles[i]);
        const glm::dvec3 turn = turn_vector(glm::conjugate(from.turns[i]) * to.turns[i]);
        state.turns[i] = from.turns[i] * turned_by(share * turn);
    }
    return state;
}

}  // namespace raks::capture
