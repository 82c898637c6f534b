#include "render/avatar/limb_parts.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::index_of;

constexpr float kAnkle = 0.9F;      // of a leg's length, from the hip
constexpr float kWrist = 0.8F;      // of an arm's, from the shoulder
constexpr float kHeadJoint = 0.6F;  // of the way from the spine's joint to the top

bool is_leg(const LimbBones& limb) noexcept {
    return limb.upper == Bone::left_upper_leg || limb.upper == Bone::right_upper_leg;
}

bool is_left(const LimbBones& limb) noexcept { return limb.upper < Bone::right_upper_leg; }

/// Where a limb points in the T-pose.
glm::vec3 direction_of(const LimbBones& limb) noexcept {
    if (is_leg(limb)) {
        return {0.0F, -1.0F, 0.0F};
    }
    return {is_left(limb) ? 1.0F : -1.0F, 0.0F, 0.0F};
}

/// How far the flesh of a bone reaches in a direction from its joint; 0: it has none.
float reach(const std::vector<FleshPoint>& flesh,
            Bone bone,
            const glm::vec3& joint,
            const glm::vec3& direction) {
    float farthest = 0.0F;
    for (const FleshPoint& point : flesh) {
        if (point.bone == index_of(bone)) {
            farthest = std::max(farthest, glm::dot(point.place - joint, direction));
        }
    }
    return farthest;
}

void add_limb_joints(const LimbBones& limb, std::vector<FleshPoint>& flesh, BonePlaces& bones) {
    const glm::vec3 joint = bones.places[index_of(limb.upper)];
    const glm::vec3 direction = direction_of(limb);
    const float length = reach(flesh, limb.upper, joint, direction);
    if (!(length > 0.0F)) {
        return;
    }
    const float end = length * (is_leg(limb) ? kAnkle : kWrist);
    const float middle = 0.5F * end;
    for (const auto& [bone, at] : {std::pair(limb.lower, middle), std::pair(limb.end, end)}) {
        bones.places[index_of(bone)] = joint + at * direction;
        bones.is_there[index_of(bone)] = true;
    }
    for (FleshPoint& point : flesh) {
        if (point.bone == index_of(limb.upper)) {
            const float at = glm::dot(point.place - joint, direction);
            point.bone = index_of(at < middle ? limb.upper : at < end ? limb.lower : limb.end);
        }
    }
}

/// An arm that ends with its forearm has its wrist within the flesh of that.
void add_wrist_joint(const LimbBones& limb, std::vector<FleshPoint>& flesh, BonePlaces& bones) {
    constexpr float kForearm = 0.58F;  // of the way from the elbow to the finger tips
    const glm::vec3 elbow = bones.places[index_of(limb.lower)];
    const glm::vec3 direction = direction_of(limb);
    const float end = kForearm * reach(flesh, limb.lower, elbow, direction);
    if (!(end > 0.0F)) {
        return;
    }
    bones.places[index_of(limb.end)] = elbow + end * direction;
    bones.is_there[index_of(limb.end)] = true;
    for (FleshPoint& point : flesh) {
        if (point.bone == index_of(limb.lower) && glm::dot(point.place - elbow, direction) > end) {
            point.bone = index_of(limb.end);
        }
    }
}

void add_head_joint(std::vector<FleshPoint>& flesh, BonePlaces& bones) {
    const glm::vec3 spine = bones.places[index_of(Bone::spine)];
    const float height = kHeadJoint * reach(flesh, Bone::spine, spine, {0.0F, 1.0F, 0.0F});
    if (!(height > 0.0F)) {
        return;
    }
    const auto head = index_of(Bone::head);
    bones.places[head] = spine + glm::vec3(0.0F, height, 0.0F);
    bones.is_there[head] = true;
    for (FleshPoint& point : flesh) {
        if (point.bone == index_of(Bone::spine) && point.place.y > bones.places[head].y) {
            point.bone = head;
        }
    }
}

}  // namespace

bool is_one_part(const LimbBones& limb,
                 const std::array<bool, motion::kBoneCount>& is_there) noexcept {
    return is_there[index_of(limb.upper)] && !is_there[index_of(limb.lower)] &&
           !is_there[index_of(limb.end)];
}

void add_lacking_joints(std::vector<FleshPoint>& flesh, BonePlaces& bones) {
    for (const LimbBones& limb : kLimbs) {
        if (is_one_part(limb, bones.is_there)) {
            add_limb_joints(limb, flesh, bones);
        } else if (!is_leg(limb) && bones.is_there[index_of(limb.lower)] &&
                   !bones.is_there[index_of(limb.end)]) {
            add_wrist_joint(limb, flesh, bones);
        }
    }
    if (bones.is_there[index_of(Bone::spine)] && !bones.is_there[index_of(Bone::head)]) {
        add_head_joint(flesh, bones);
    }
}

glm::quat swing_of_part(const LimbBones& limb, const motion::Pose& pose) noexcept {
    const glm::vec3 straight = direction_of(limb);
    const glm::vec3 bent = straight + pose.rotation(limb.lower) * straight;
    const float length = glm::length(bent);
    constexpr float kFolded = 1e-3F;
    if (length < kFolded) {
        return {1.0F, 0.0F, 0.0F, 0.0F};
    }
    // Half the bend: never a half turn.
    const glm::vec3 to = bent / length;
    const glm::vec3 axis = glm::cross(straight, to);
    return glm::normalize(glm::quat(1.0F + glm::dot(straight, to), axis.x, axis.y, axis.z));
}

}  // namespace raks::render
