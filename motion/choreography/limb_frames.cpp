#include "motion/choreography/limb_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/choreography/splines.hpp"
#include "motion/skeleton/pose.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace raks::motion {
namespace {

const glm::dvec3 kX{1, 0, 0};
const glm::dvec3 kY{0, 1, 0};
const glm::dvec3 kZ{0, 0, 1};

glm::dvec3 offset_of(const Skeleton& skeleton, Bone bone) noexcept {
    return glm::dvec3(skeleton.offsets[index_of(bone)]);
}

// Stores a rotation that was computed in double precision.
void set(Pose& pose, Bone bone, const glm::dquat& rotation) noexcept {
    pose.rotation(bone) = glm::quat(glm::normalize(rotation));
}

/// Orthonormal axes: the first direction, the second one made perpendicular to it, and their cross
/// product.
glm::dmat3 axes_of(const glm::dvec3& first, const glm::dvec3& second) noexcept {
    const glm::dvec3 a = glm::normalize(first);
    const glm::dvec3 b = glm::normalize(second - a * glm::dot(second, a));
    return {a, b, glm::cross(a, b)};
}

/// The rotation that turns `from` to `to` exactly and `from_side` to `to_side` as far as that
/// allows.
glm::dquat aligned(const glm::dvec3& from,
                   const glm::dvec3& from_side,
                   const glm::dvec3& to,
                   const glm::dvec3& to_side) noexcept {
    return glm::quat_cast(axes_of(to, to_side) * glm::transpose(axes_of(from, from_side)));
}

/// Vector from the root to the middle joint of two bones (law of cosines); `pole` gives the side to
/// which it bends.
glm::dvec3 middle_joint(const glm::dvec3& to_end,
                        const glm::dvec3& pole,
                        double upper,
                        double lower) noexcept {
    const double distance = glm::length(to_end);
    const glm::dvec3 line = to_end / distance;
    const glm::dvec3 side = glm::normalize(pole - line * glm::dot(pole, line));
    const double along = (upper * upper - lower * lower + distance * distance) / (2.0 * distance);
    return line * along + side * std::sqrt(std::max(0.0, upper * upper - along * along));
}

// Product of local rotations down a chain.
glm::dquat world_rotation(const Pose& pose, std::initializer_list<Bone> chain) noexcept {
    glm::dquat rotation{1, 0, 0, 0};
    for (const Bone bone : chain) {
        rotation = rotation * glm::dquat(pose.rotation(bone));
    }
    return rotation;
}

// A share of a rotation, along the same axis.
glm::dquat share_of(const glm::dquat& rotation, double share) noexcept {
    return glm::slerp(glm::dquat(1, 0, 0, 0), rotation, share);
}

double sign_of(Side side) noexcept { return side == Side::left ? 1.0 : -1.0; }

/// Soft maximum of value and 0.
double soft_positive(double value, double width) noexcept {
    return -soft_least(-value, 0.0, width);
}

/// Bend of the toes, radians: flat on the floor under a raised heel, and in the air only as far as
/// the floor still forces them.
double toe_bend(const Skeleton& skeleton, const PlannedFoot& foot, double pitch) noexcept {
    const double toes = static_cast<double>(skeleton.toe_tip.z - skeleton.ball.z);
    const double free = std::asin(std::clamp(foot.height / toes, 0.0, 1.0));
    return std::max(0.0, pitch - free);
}

}  // namespace

double LegLengths::at_bend(double bend) const noexcept {
    return std::sqrt(thigh * thigh + shin * shin + 2.0 * thigh * shin * std::cos(bend));
}

LegLengths leg_lengths(const Skeleton& skeleton) noexcept {
    return {glm::length(offset_of(skeleton, Bone::left_lower_leg)),
            glm::length(offset_of(skeleton, Bone::left_foot))};
}

glm::dvec3 hip_joint(const Skeleton& skeleton,
                     Side side,
                     const glm::dquat& pelvis,
                     const glm::dvec3& hips) noexcept {
    return hips + pelvis * offset_of(skeleton, on_side(Bone::left_upper_leg, side));
}

void set_trunk(const Skeleton& skeleton,
               const BodyFrame& frame,
               const glm::dvec3& hips,
               Pose& pose) noexcept {
    constexpr double kSpine = 0.36;  // share of the bend between pelvis and chest...
    constexpr double kChest = 0.32;  // ... in the lower two joints; the third takes the rest
    const glm::dquat facing = glm::angleAxis(frame.facing, kY);
    const glm::dquat pelvis = facing * frame.pelvis.rotation();
    const glm::dquat chest = facing * frame.chest.rotation();
    const glm::dquat head = facing * frame.head.rotation();
    // The slide tilts the spine; the upper chest takes the tilt back, so that the chest moves
    // without turning.
    const double lever = glm::length(offset_of(skeleton, Bone::chest)) +
                         glm::length(offset_of(skeleton, Bone::upper_chest));
    const auto angle = [&](double slide) {
        return std::asin(std::clamp(slide / lever, -0.8, 0.8));
    };
    const glm::dquat slide = glm::angleAxis(-angle(frame.chest_slide.x), kZ) *
                             glm::angleAxis(angle(frame.chest_slide.y), kX);
    const glm::dquat bend = glm::conjugate(pelvis) * chest;
    const glm::dquat spine = share_of(bend, kSpine) * slide;
    const glm::dquat middle = share_of(bend, kChest);
    pose.hips_position = glm::vec3(hips);
    set(pose, Bone::hips, pelvis);
    set(pose, Bone::spine, spine);
    set(pose, Bone::chest, middle);
    set(pose, Bone::upper_chest, glm::conjugate(pelvis * spine * middle) * chest);
    // Neck and head take half of the head's turn each.
    const glm::dquat nod = glm::conjugate(chest) * head;
    const glm::dquat neck = share_of(nod, 0.5);
    set(pose, Bone::neck, neck);
    set(pose, Bone::head, glm::conjugate(neck) * nod);
}

void set_leg(const Skeleton& skeleton,
             Side side,
             const PlannedFoot& foot,
             double extra_pitch,
             Pose& pose) noexcept {
    constexpr double kSoftPull = 0.014;  // metres of transition
    constexpr double kFootShare = 0.7;   // of the knee's direction; the rest is the pelvis'
    const LegLengths lengths = leg_lengths(skeleton);
    const glm::dquat pelvis(pose.rotation(Bone::hips));
    const glm::dvec3 joint = hip_joint(skeleton, side, pelvis, glm::dvec3(pose.hips_position));
    glm::dvec3 to_ankle = ankle_of(skeleton, side, foot, extra_pitch) - joint;
    const double wanted = glm::length(to_ankle);
    // A standing foot must not move: it is cut off sharply, and peel_heels() prevents that.
    const double pull = foot.is_swinging ? soft_least(wanted, lengths.reach(), kSoftPull) : wanted;
    to_ankle *= std::min(pull, lengths.reach()) / wanted;

    const glm::dvec3 pole =
        kFootShare * (foot_rotation(foot.yaw, 0.0) * kZ) + (1.0 - kFootShare) * (pelvis * kZ);
    const glm::dvec3 knee = middle_joint(to_ankle, pole, lengths.thigh, lengths.shin);
    // Axis of the knee, which both bones keep.
    const glm::dvec3 hinge = glm::cross(pole, to_ankle);
    const Bone upper = on_side(Bone::left_upper_leg, side);
    const Bone lower = on_side(Bone::left_lower_leg, side);
    const Bone end = on_side(Bone::left_foot, side);
    const glm::dquat thigh = aligned(offset_of(skeleton, lower), kX, knee, hinge);
    const glm::dquat shin = aligned(offset_of(skeleton, end), kX, to_ankle - knee, hinge);
    const double pitch = foot.pitch + extra_pitch;
    set(pose, upper, glm::conjugate(pelvis) * thigh);
    set(pose, lower, glm::conjugate(thigh) * shin);
    set(pose, end, glm::conjugate(shin) * foot_rotation(foot.yaw, pitch));
    set(pose, on_side(Bone::left_toes, side), glm::angleAxis(-toe_bend(skeleton, foot, pitch), kX));
    pose.foot_contact[static_cast<std::size_t>(side)] = !foot.is_swinging;
}

void set_arm(const Skeleton& skeleton, Side side, const BodyFrame& frame, Pose& pose) noexcept {
    constexpr double kClavicleShare = 0.19;  // of the arm's lift that the collarbone takes...
    constexpr double kClavicleFrom = -35.0 * kDegree;  // ... above this angle
    constexpr double kClavicleSoft = 6.0 * kDegree;    // transition
    const double sign = sign_of(side);
    const ArmAngles& arm = frame.arms[static_cast<std::size_t>(side)];
    const Bone clavicle = on_side(Bone::left_shoulder, side);
    const Bone upper = on_side(Bone::left_upper_arm, side);
    const Bone lower = on_side(Bone::left_lower_arm, side);
    const Bone end = on_side(Bone::left_hand, side);

    const glm::dquat chest =
        world_rotation(pose, {Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest});
    const double raised =
        arm.shoulder_up + kClavicleShare * soft_positive(arm.up - kClavicleFrom, kClavicleSoft);
    const glm::dquat shoulder = chest * glm::angleAxis(sign * raised, kZ);

    const glm::dquat held = glm::angleAxis(frame.facing, kY) * frame.arm_frame.rotation();
    // Direction from shoulder to hand, in the arms' frame.
    const glm::dvec3 line = held * glm::dvec3(sign * std::cos(arm.up) * std::cos(arm.front),
                                              std::sin(arm.up),
                                              std::cos(arm.up) * std::sin(arm.front));
    const double a = glm::length(offset_of(skeleton, lower));
    const double b = glm::length(offset_of(skeleton, end));
    // Distance from shoulder to hand at this bend (law of cosines).
    const double reach = std::sqrt(a * a + b * b + 2.0 * a * b * std::cos(arm.bend));
    // At elbow angle 0 the elbow points down, out and back.
    const glm::dvec3 down = held * glm::dvec3(sign * 0.45, -1.0, -0.55);
    const glm::dvec3 pole = glm::angleAxis(-sign * arm.elbow, line) *
                            glm::normalize(down - line * glm::dot(down, line));
    const glm::dvec3 elbow = middle_joint(reach * line, pole, a, b);
    const glm::dvec3 hinge = glm::cross(line, pole);
    const glm::dvec3 rest_hinge = sign * kY;
    const glm::dquat upper_world = aligned(offset_of(skeleton, lower), rest_hinge, elbow, hinge);
    const glm::dquat lower_world =
        aligned(offset_of(skeleton, end), rest_hinge, reach * line - elbow, hinge);
    // The palm's turn is shared by forearm and wrist, as radius and ulna turn.
    const glm::dquat half_turn = glm::angleAxis(-0.5 * arm.hand_turn, kX);
    set(pose, clavicle, glm::conjugate(chest) * shoulder);
    set(pose, upper, glm::conjugate(shoulder) * upper_world);
    set(pose, lower, glm::conjugate(upper_world) * lower_world * half_turn);
    set(pose, end, half_turn * glm::angleAxis(-sign * arm.hand_bend, kZ));
    set_hand_shape(side, arm.fist, pose);
}

glm::dvec3 centre_of_mass(const Skeleton& skeleton, const Pose& pose) noexcept {
    const WorldPose world = world_body(skeleton, pose);
    const auto at = [&](Bone bone) { return glm::dvec3(world.position(bone)); };
    // Trunk and head, then the limbs of both sides: shares of the mass at points along the
    // segments.
    glm::dvec3 sum =
        0.142 * at(Bone::hips) + 0.139 * at(Bone::chest) +
        0.216 * glm::mix(at(Bone::upper_chest), at(Bone::neck), 0.4) +
        0.081 * (at(Bone::head) + 0.06 * (glm::dquat(world.rotation(Bone::head)) * kY));
    struct Segment {
        double mass;
        Bone from;  // left
        Bone to;
        double share;
    };
    constexpr std::array<Segment, 6> kSegments = {{
        {0.028, Bone::left_upper_arm, Bone::left_lower_arm, 0.436},
        {0.016, Bone::left_lower_arm, Bone::left_hand, 0.43},
        {0.006, Bone::left_hand, Bone::left_middle_proximal, 0.8},
        {0.100, Bone::left_upper_leg, Bone::left_lower_leg, 0.433},
        {0.0465, Bone::left_lower_leg, Bone::left_foot, 0.433},
        {0.0145, Bone::left_foot, Bone::left_toes, 0.5},
    }};
    for (const Segment& segment : kSegments) {
        for (const Side side : kSides) {
            sum += segment.mass * glm::mix(at(on_side(segment.from, side)),
                                           at(on_side(segment.to, side)),
                                           segment.share);
        }
    }
    return sum;
}

}  // namespace raks::motion
