#include "motion/choreography/joint_limits.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

// After the ranges of people's joints (American Academy of Orthopaedic Surgeons); sums over several
// axes are a little wider.
constexpr std::array<JointLimit, 14> kJointLimits = {{
    {"trunk", {Bone::spine, Bone::chest, Bone::upper_chest}, 3, 0, 85},
    {"neck", {Bone::neck, Bone::head, Bone::head}, 2, 0, 75},
    {"left hip", {Bone::left_upper_leg, {}, {}}, 1, 0, 125},
    {"right hip", {Bone::right_upper_leg, {}, {}}, 1, 0, 125},
    {"left knee", {Bone::left_lower_leg, {}, {}}, 1, 3, 150},
    {"right knee", {Bone::right_lower_leg, {}, {}}, 1, 3, 150},
    {"left ankle", {Bone::left_foot, {}, {}}, 1, 0, 75},
    {"right ankle", {Bone::right_foot, {}, {}}, 1, 0, 75},
    {"left collarbone", {Bone::left_shoulder, {}, {}}, 1, 0, 60},
    {"right collarbone", {Bone::right_shoulder, {}, {}}, 1, 0, 60},
    {"left elbow", {Bone::left_lower_arm, {}, {}}, 1, 0, 160},
    {"right elbow", {Bone::right_lower_arm, {}, {}}, 1, 0, 160},
    {"left wrist", {Bone::left_hand, {}, {}}, 1, 0, 95},
    {"right wrist", {Bone::right_hand, {}, {}}, 1, 0, 95},
}};

// Angle of the product of the bones' rotations, degrees; |w| takes the shorter way round.
double turn_of(const Pose& pose, const JointLimit& limit) noexcept {
    glm::quat rotation = kNoRotation;
    for (const Bone bone : limit.bones()) {
        rotation = rotation * pose.rotation(bone);
    }
    const double w = std::min(1.0, std::abs(static_cast<double>(rotation.w)));
    return 2.0 * std::acos(w) * 180.0 / M_PI;
}

}  // namespace

std::span<const JointLimit> joint_limits() noexcept { return kJointLimits; }

std::optional<JointExcess> worst_joint(const Pose& pose) noexcept {
    std::optional<JointExcess> worst;
    for (const JointLimit& limit : kJointLimits) {
        const JointExcess excess{limit.joint, turn_of(pose, limit), limit.lowest, limit.highest};
        if (excess.beyond() > (worst ? worst->beyond() : 0.0)) {
            worst = excess;
        }
    }
    return worst;
}

}  // namespace raks::motion
