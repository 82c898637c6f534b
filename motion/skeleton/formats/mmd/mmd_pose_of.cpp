#include "motion/skeleton/formats/mmd/mmd_pose_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "motion/skeleton/body/bone_aims.hpp"
#include "motion/skeleton/formats/mmd/mmd_clip.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::motion {
namespace {

using B = MmdBone;

const glm::dvec3 kAcross(1.0, 0.0, 0.0);
constexpr double kMostSpine = 0.5;  // radians by which a round may turn the lower spine

// A thigh's turn and its knee's bend about x.
struct Hinged {
    glm::dquat thigh{1.0, 0.0, 0.0, 0.0};
    glm::dquat knee{1.0, 0.0, 0.0, 0.0};
};

// The thigh and the shin that point as `thigh` and `shin` do, with a knee that bends about x alone:
// the thigh is turned about itself until the shin lies in the plane of the hinge. A leg that is
// nearly straight has no such plane: its thigh turns by at most a little, and the bend is the one
// that comes nearest. `upper`, `lower`: to the knee and on to the ankle at rest.
Hinged hinged_leg(const glm::dquat& thigh,
                  const glm::dquat& shin,
                  const glm::dvec3& upper,
                  const glm::dvec3& lower) {
    constexpr double kMostTwist = 50.0 * glm::pi<double>() / 180.0;
    const glm::dvec3 along = glm::normalize(upper);
    const glm::dvec3 aim = glm::conjugate(thigh) * (shin * lower);  // in the thigh's frame
    // The x of the aim, turned about the thigh by -angle, shall be that of the shin at rest:
    // a cos(angle) + b sin(angle) + c.
    const glm::dvec3 off = aim - along * glm::dot(along, aim);
    const double a = off.x;
    const double b = -glm::cross(along, off).x;
    const double c = along.x * glm::dot(along, aim);
    const double reach = std::hypot(a, b);
    double angle = 0.0;
    if (reach > 1e-9) {
        const double middle = std::atan2(b, a);
        const double half = std::acos(std::clamp((lower.x - c) / reach, -1.0, 1.0));
        const double one = std::remainder(middle + half, glm::two_pi<double>());
        const double other = std::remainder(middle - half, glm::two_pi<double>());
        angle = std::abs(one) < std::abs(other) ? one : other;
    }
    angle = std::clamp(angle, -kMostTwist, kMostTwist);
    const glm::dvec3 seen = glm::angleAxis(-angle, along) * aim;
    const double bend =
        std::atan2(lower.y * seen.z - lower.z * seen.y, lower.y * seen.y + lower.z * seen.z);
    return {glm::normalize(thigh * glm::angleAxis(angle, along)), glm::angleAxis(bend, kAcross)};
}

// Puts turns in the world into the frames of parents.
class PoseWriter {
 public:
    PoseWriter(const MmdBody& body, const Skeleton& skeleton, const Pose& pose, MmdLegs legs)
        : body_(body),
          skeleton_(skeleton),
          legs_(legs),
          scale_(hips_over_floor() / static_cast<double>(skeleton.hips_height())) {
        const WorldPose world = world_pose(skeleton, pose);
        for (std::size_t i = 0; i < turns_.size(); ++i) {
            turns_[i] = glm::normalize(glm::dquat(world.rotations[i]));
        }
        hips_ = scale_ * glm::dvec3(pose.hips_position);
    }

    MmdPose write() {
        write_trunk();
        for (const Side side : kSides) {
            write_arm(side);
            write_leg(side);
            pose_.leg_ik[static_cast<std::size_t>(side)] = legs_ == MmdLegs::ik;
            pose_.toe_ik[static_cast<std::size_t>(side)] = legs_ == MmdLegs::ik;
        }
        if (legs_ == MmdLegs::ik) {
            write_goals();
        }
        return pose_;
    }

 private:
    static double hips_over_floor() {
        double height = kMmdHipsOverLegs;
        for (std::optional<B> at = B::left_leg; at; at = mmd_bone_rows()[index_of(*at)].parent) {
            height += mmd_bone_rows()[index_of(*at)].offset.y;
        }
        return height;
    }

    [[nodiscard]] const glm::dquat& turn(Bone bone) const { return turns_[index_of(bone)]; }
    void put(MmdBone bone, const glm::dquat& above, const glm::dquat& turn) {
        pose_.turns[index_of(bone)] = glm::normalize(glm::conjugate(above) * turn);
    }

    void write_trunk() {
        const glm::dquat& hips = turn(Bone::hips);
        const glm::dquat none(1.0, 0.0, 0.0, 0.0);
        put(B::lower_body, none, hips);
        const glm::dquat lower = lower_spine();
        put(B::upper_body, none, lower);
        put(B::upper_body2, lower, turn(Bone::upper_chest));
        put(B::neck, turn(Bone::upper_chest), turn(Bone::neck));
        put(B::head, turn(Bone::neck), turn(Bone::head));
        // The center carries the waist, about which the legs' roots turn with the lower body.
        const glm::dvec3 to_legs(0.0, body_.offset(B::left_waist_cancel).y, 0.0);
        const glm::dvec3 legs = hips_ - hips * glm::dvec3(0.0, kMmdHipsOverLegs, 0.0);
        glm::dvec3 waist(0.0);
        for (const B bone : {B::center, B::groove, B::waist, B::lower_body}) {
            waist += body_.offset(bone);
        }
        pose_.places[index_of(B::center)] = legs - hips * to_legs - waist;
    }

    // Three turns in two bones: the upper one keeps the turn of the upper chest, the lower one
    // leads to where that is. Who reads it puts the middle joint half way between both.
    [[nodiscard]] glm::dquat lower_spine() const {
        const glm::dvec3 first(skeleton_.offsets[index_of(Bone::chest)]);
        const glm::dvec3 second(skeleton_.offsets[index_of(Bone::upper_chest)]);
        const glm::dvec3 goal = turn(Bone::spine) * first + turn(Bone::chest) * second;
        glm::dquat lower = turn(Bone::spine);
        constexpr int kRounds = 3;
        for (int round = 0; round < kRounds; ++round) {
            const glm::dquat middle =
                glm::normalize(glm::slerp(lower, turn(Bone::upper_chest), 0.5));
            const glm::dvec3 reached = lower * first + middle * second;
            // What is carried by the middle joint goes half of the way.
            const double share = glm::length(first) / glm::length(reached) +
                                 0.5 * glm::length(second) / glm::length(reached);
            const glm::dquat way = shortest_turn(glm::normalize(reached), glm::normalize(goal));
            lower = glm::normalize(
                glm::angleAxis(std::min(glm::angle(way) / share, kMostSpine), glm::axis(way)) *
                lower);
        }
        return lower;
    }

    void write_arm(Side side) {
        const glm::dquat rest = glm::conjugate(body_.arm_at_rest(side));
        const auto at_rest = [&](Bone left) { return turn(on_side(left, side)) * rest; };
        put(on_side(B::left_shoulder, side),
            turn(Bone::upper_chest),
            turn(on_side(Bone::left_shoulder, side)));
        put(on_side(B::left_arm, side),
            turn(on_side(Bone::left_shoulder, side)),
            at_rest(Bone::left_upper_arm));
        put(on_side(B::left_elbow, side),
            at_rest(Bone::left_upper_arm),
            at_rest(Bone::left_lower_arm));
        put(on_side(B::left_wrist, side), at_rest(Bone::left_lower_arm), at_rest(Bone::left_hand));
        // Both tables have the fingers in one order.
        constexpr std::size_t kFingerBones = 15;
        for (std::size_t i = 0; i < kFingerBones; ++i) {
            const auto bone = static_cast<Bone>(index_of(Bone::left_thumb_metacarpal) + i);
            const auto mmd = static_cast<MmdBone>(index_of(B::left_thumb0) + i);
            const auto above = static_cast<Bone>(kBoneParents[index_of(bone)]);
            put(on_side(mmd, side), at_rest(above), at_rest(bone));
        }
    }

    void write_leg(Side side) {
        glm::dquat thigh = turn(on_side(Bone::left_upper_leg, side));
        glm::dquat shin = turn(on_side(Bone::left_lower_leg, side));
        if (legs_ == MmdLegs::ik) {
            const Hinged leg = hinged_leg(thigh,
                                          shin,
                                          body_.offset(on_side(B::left_knee, side)),
                                          body_.offset(on_side(B::left_ankle, side)));
            thigh = leg.thigh;
            shin = leg.thigh * leg.knee;
        }
        const glm::dquat& foot = turn(on_side(Bone::left_foot, side));
        put(on_side(B::left_leg, side), turn(Bone::hips), thigh);
        put(on_side(B::left_knee, side), thigh, shin);
        put(on_side(B::left_ankle, side), shin, foot);
        put(on_side(B::left_toe_ex, side), foot, turn(on_side(Bone::left_toes, side)));
    }

    // The feet's goals, where the turns alone put the ankles.
    void write_goals() {
        MmdPose turned = pose_;
        turned.leg_ik = turned.toe_ik = {false, false};
        const MmdWorld world = body_.world(turned);
        for (const Side side : kSides) {
            const B goal = on_side(B::left_leg_ik, side);
            const glm::dvec3 rest =
                body_.offset(on_side(B::left_leg_ik_parent, side)) + body_.offset(goal);
            pose_.places[index_of(goal)] = world.place(on_side(B::left_ankle, side)) - rest;
            pose_.turns[index_of(goal)] = turn(on_side(Bone::left_foot, side));
        }
    }

    const MmdBody& body_;
    const Skeleton& skeleton_;
    MmdLegs legs_;
    double scale_;
    glm::dvec3 hips_{};
    std::array<glm::dquat, kBoneCount> turns_{};  // in the world
    MmdPose pose_;
};

}  // namespace

MmdPose mmd_pose_of(const MmdBody& body, const Skeleton& skeleton, const Pose& pose, MmdLegs legs) {
    return PoseWriter(body, skeleton, pose, legs).write();
}

}  // namespace raks::motion
