#include "motion/skeleton/body/bone_aims.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <vector>

#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

// Of the thigh's length: joints nearer than that are one place (CMU's LHipJoint, LowerBack).
constexpr double kApart = 0.01;

/// Place of a bone in the mannequin's T-pose, from the hips.
glm::dvec3 t_pose_place(Bone bone) {
    glm::dvec3 place(0.0);
    while (bone != Bone::hips) {
        place += glm::dvec3(mannequin_skeleton().offsets[index_of(bone)]);
        bone = static_cast<Bone>(kBoneParents[index_of(bone)]);
    }
    return place;
}

bool is_on_right(Bone bone) { return index_of(bone) > index_of(mirrored(bone)); }

/// The bone that goes on from a bone of the middle or the left; none: a last one.
std::optional<Bone> next_bone(Bone bone) {
    switch (bone) {
        case Bone::hips:
            return Bone::spine;
        case Bone::upper_chest:
            return Bone::neck;
        case Bone::left_hand:
            return Bone::left_middle_proximal;
        default:
            break;
    }
    for (std::size_t child = 1; child < kBoneParents.size(); ++child) {
        if (kBoneParents[child] == index_of(bone)) {
            return static_cast<Bone>(child);
        }
    }
    return std::nullopt;
}

/// Bones that a bone may point to, the best first.
std::vector<Bone> next_bones(Bone bone) {
    const Side side = is_on_right(bone) ? Side::right : Side::left;
    std::vector<Bone> next;
    const Bone start = side == Side::right ? mirrored(bone) : bone;
    for (auto at = next_bone(start); at; at = next_bone(*at)) {
        next.push_back(on_side(*at, side));
    }
    if (start == Bone::left_hand) {
        for (const Bone finger :
             {Bone::left_index_proximal, Bone::left_ring_proximal, Bone::left_little_proximal}) {
            next.push_back(on_side(finger, side));
        }
    }
    return next;
}

/// Directions between the joints of three bones: of `base`'s frame, from `from` to `to`.
std::optional<BoneAim> aim_between(const PosedBody& body, Bone base, Bone from, Bone to) {
    if (!body.has(from) || !body.has(to)) {
        return std::nullopt;
    }
    const std::size_t joint = body.joint(base);
    const glm::dvec3 vector =
        body.local_vector(joint, body.joint(to)) - body.local_vector(joint, body.joint(from));
    const double least = kApart * body.distance(Bone::left_upper_leg, Bone::left_lower_leg);
    if (!(glm::length(vector) > least)) {
        return std::nullopt;
    }
    return BoneAim{glm::normalize(vector), glm::normalize(t_pose_place(to) - t_pose_place(from))};
}

/// The tip of a last joint.
std::optional<BoneAim> tip_aim(const PosedBody& body, Bone bone) {
    const auto& end = body.clip().joints[body.joint(bone)].end_site;
    if (!end || !(glm::length(*end) > 1e-9)) {
        return std::nullopt;
    }
    glm::dvec3 in_t_pose(mannequin_skeleton().offsets[index_of(bone)]);
    if (bone == Bone::left_foot || bone == Bone::right_foot) {
        in_t_pose = glm::dvec3(mannequin_skeleton().toe_tip);
        in_t_pose.x *= bone == Bone::right_foot ? -1.0 : 1.0;
    }
    return BoneAim{glm::normalize(*end), glm::normalize(in_t_pose), true};
}

/// The bone of the trunk that carries the shoulders or, without them, the arms.
bool carries_shoulders(const PosedBody& body, Bone bone) {
    for (const Bone arm : {Bone::left_shoulder, Bone::left_upper_arm}) {
        if (body.has(arm) && body.has(mirrored(arm))) {
            return mapped_parent(body.mapping(), arm) == bone;
        }
    }
    return false;
}

}  // namespace

std::optional<BoneAim> bone_aim(const PosedBody& body, Bone bone) {
    for (const Bone next : next_bones(bone)) {
        if (auto aim = aim_between(body, bone, bone, next)) {
            return aim;
        }
    }
    return tip_aim(body, bone);
}

std::optional<BoneAim> lateral_aim(const PosedBody& body, Bone bone) {
    if (bone == Bone::hips) {
        return aim_between(body, bone, Bone::right_upper_leg, Bone::left_upper_leg);
    }
    if (bone == Bone::left_hand || bone == Bone::right_hand) {
        const Side side = bone == Bone::left_hand ? Side::left : Side::right;
        return aim_between(body,
                           bone,
                           on_side(Bone::left_little_proximal, side),
                           on_side(Bone::left_index_proximal, side));
    }
    if (!carries_shoulders(body, bone)) {
        return std::nullopt;
    }
    // CMU's shoulders lie in one place: then their arms tell, whose mean is in the middle.
    auto aim = aim_between(body, bone, Bone::right_shoulder, Bone::left_shoulder);
    return aim ? aim : aim_between(body, bone, Bone::right_upper_arm, Bone::left_upper_arm);
}

glm::dquat shortest_turn(const glm::dvec3& from, const glm::dvec3& to) {
    const double cosine = glm::dot(from, to);
    if (cosine > 1.0 - 1e-15) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    if (cosine < -1.0 + 1e-9) {
        const glm::dvec3 y(0.0, 1.0, 0.0);
        const glm::dvec3 across = y - glm::dot(y, from) * from;
        const glm::dvec3 axis = glm::length(across) > 0.1
                                    ? glm::normalize(across)
                                    : glm::normalize(glm::dvec3(1.0, 0.0, 0.0) - from.x * from);
        return {0.0, axis.x, axis.y, axis.z};
    }
    const glm::dvec3 axis = glm::cross(from, to);
    return glm::normalize(glm::dquat(1.0 + cosine, axis.x, axis.y, axis.z));
}

}  // namespace raks::motion
