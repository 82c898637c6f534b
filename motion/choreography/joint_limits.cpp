#include "motion/choreography/joint_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace raks::motion {
namespace {

// A joint, or several in a row, whose total angle of rotation is limited; degrees.
struct JointLimit {
    std::string_view name;
    std::array<Bone, 3> bones;  // the first `count` in a row turn together
    int count;
    double lowest;
    double highest;
};

// After the ranges of people's joints (American Academy of Orthopaedic Surgeons); sums over several
// axes are a little wider.
constexpr std::array<JointLimit, 14> kLimits = {{
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
    for (int i = 0; i < limit.count; ++i) {
        rotation = rotation * pose.rotation(limit.bones[static_cast<std::size_t>(i)]);
    }
    const double w = std::min(1.0, std::abs(static_cast<double>(rotation.w)));
    return 2.0 * std::acos(w) * 180.0 / M_PI;
}

}  // namespace

std::optional<JointExcess> worst_joint(const Pose& pose) noexcept {
    std::optional<JointExcess> worst;
    for (const JointLimit& limit : kLimits) {
        const JointExcess excess{limit.name, turn_of(pose, limit), limit.lowest, limit.highest};
        if (excess.beyond() > (worst ? worst->beyond() : 0.0)) {
            worst = excess;
        }
    }
    return worst;
}

}  // namespace raks::motion
