#include "render/mannequin/helper_joints.hpp"

namespace raks::render {
namespace {

using motion::Bone;

constexpr float kShoulderLift = 0.030F;  // metres, by eye

// A helper of the left side; the right one has another name and mirrored bones.
struct LeftHelper {
    std::string_view left_name;
    std::string_view right_name;
    HelperKind kind;
    Bone parent;
    Bone source;
    glm::vec3 roll_axis;
};

// Roll axes: in the T-pose the arm's bones lie along x, the leg's along y.
constexpr glm::vec3 kAlongArmAxis{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kAlongLegAxis{0.0F, 1.0F, 0.0F};

constexpr std::array kLeftHelpers = {
    LeftHelper{"leftShoulderHalf",
               "rightShoulderHalf",
               HelperKind::half_swing,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftUpperArmTwist",
               "rightUpperArmTwist",
               HelperKind::swing_half_roll,
               Bone::left_shoulder,
               Bone::left_upper_arm,
               kAlongArmAxis},
    LeftHelper{"leftElbowHalf",
               "rightElbowHalf",
               HelperKind::half_rotation,
               Bone::left_upper_arm,
               Bone::left_lower_arm,
               kAlongArmAxis},
    LeftHelper{"leftLowerArmTwist",
               "rightLowerArmTwist",
               HelperKind::half_roll,
               Bone::left_lower_arm,
               Bone::left_hand,
               kAlongArmAxis},
    LeftHelper{"leftHipHalf",
               "rightHipHalf",
               HelperKind::half_swing,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftUpperLegTwist",
               "rightUpperLegTwist",
               HelperKind::swing_half_roll,
               Bone::hips,
               Bone::left_upper_leg,
               kAlongLegAxis},
    LeftHelper{"leftKneeHalf",
               "rightKneeHalf",
               HelperKind::half_rotation,
               Bone::left_upper_leg,
               Bone::left_lower_leg,
               kAlongLegAxis},
};
static_assert(2 * kLeftHelpers.size() == kHelperCount);

/// The helper on one side of the body, placed by the skeleton's rest offsets.
HelperJoint on_side(const LeftHelper& left,
                    motion::Side side,
                    const motion::Skeleton& skeleton) noexcept {
    HelperJoint helper;
    helper.name = side == motion::Side::left ? left.left_name : left.right_name;
    helper.kind = left.kind;
    helper.parent = motion::on_side(left.parent, side);
    helper.source = motion::on_side(left.source, side);
    helper.roll_axis = left.roll_axis;
    // The forearm's helper turns about the elbow, all others about their source's joint.
    helper.offset = left.kind == HelperKind::half_roll
                        ? glm::vec3{0.0F}
                        : skeleton.offsets[motion::index_of(helper.source)];
    // Only the armpit's helper is lifted under a raised arm.
    const bool is_shoulder =
        left.kind == HelperKind::half_swing && left.source == Bone::left_upper_arm;
    helper.lift = is_shoulder ? kShoulderLift : 0.0F;
    return helper;
}

}  // namespace

std::array<HelperJoint, kHelperCount> mannequin_helpers(const motion::Skeleton& skeleton) noexcept {
    std::array<HelperJoint, kHelperCount> helpers{};
    for (std::size_t i = 0; i < kLeftHelpers.size(); ++i) {
        helpers[i] = on_side(kLeftHelpers[i], motion::Side::left, skeleton);
        helpers[i + kLeftHelpers.size()] = on_side(kLeftHelpers[i], motion::Side::right, skeleton);
    }
    return helpers;
}

}  // namespace raks::render
