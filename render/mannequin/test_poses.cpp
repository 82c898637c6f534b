#include "render/mannequin/test_poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"
#include "render/mannequin/bind_pose.hpp"

#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::Pose;
using motion::Side;

struct BoneRotation {
    Bone bone;
    glm::quat rotation;  // w, x, y, z
};

// One thigh raised past the horizontal with the knee bent, both forearms folded over the chest.
constexpr std::array kCross = {
    BoneRotation{Bone::left_upper_leg, {0.67559F, -0.73728F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_lower_leg, {0.57358F, 0.81915F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_foot, {0.9763F, 0.21644F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_upper_arm, {0.79973F, 0.12414F, -0.55998F, -0.1773F}},
    BoneRotation{Bone::left_lower_arm, {0.46175F, 0.0F, -0.88701F, 0.0F}},
    BoneRotation{Bone::right_upper_arm, {0.79973F, 0.12414F, 0.55998F, 0.1773F}},
    BoneRotation{Bone::right_lower_arm, {0.46175F, 0.0F, 0.88701F, 0.0F}},
};
// Arms hanging beside the body.
constexpr std::array kDown = {
    BoneRotation{Bone::left_upper_leg, {0.99966F, 0.0F, 0.0F, 0.02618F}},
    BoneRotation{Bone::left_foot, {0.99722F, -0.00183F, 0.06973F, -0.02611F}},
    BoneRotation{Bone::left_shoulder, {0.99939F, 0.0F, 0.0F, -0.0349F}},
    BoneRotation{Bone::left_upper_arm, {0.81081F, 0.11249F, -0.05724F, -0.57153F}},
    BoneRotation{Bone::left_lower_arm, {0.99027F, 0.0F, -0.13917F, 0.0F}},
};
// Left elbow bent by 140 degrees.
constexpr std::array kElbowBend = {
    BoneRotation{Bone::left_lower_arm, {0.34202F, 0.0F, -0.93969F, 0.0F}},
};
// Left thigh raised by 115 degrees, the knee bent by 90.
constexpr std::array kHipBend = {
    BoneRotation{Bone::left_upper_leg, {0.5373F, -0.84339F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_lower_leg, {0.70711F, 0.70711F, 0.0F, 0.0F}},
};
// Left thigh raised by 60 degrees, the knee bent by 135.
constexpr std::array kKneeBend = {
    BoneRotation{Bone::left_upper_leg, {0.86603F, -0.5F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_lower_leg, {0.38268F, 0.92388F, 0.0F, 0.0F}},
};
// Both arms over the head, the collar bones raised by 22 degrees.
constexpr std::array kOver = {
    BoneRotation{Bone::left_shoulder, {0.98163F, 0.0F, 0.0F, 0.19081F}},
    BoneRotation{Bone::left_upper_arm, {0.74233F, -0.42858F, -0.25752F, 0.44604F}},
    BoneRotation{Bone::left_lower_arm, {0.9703F, 0.0F, -0.24192F, 0.0F}},
    BoneRotation{Bone::left_hand, {0.99619F, 0.0F, 0.0F, -0.08716F}},
};
// A pose of a dance: every joint of trunk, arms and legs turned a little, left and right
// differently.
constexpr std::array kSideStep = {
    BoneRotation{Bone::hips, {0.99069F, -0.00744F, 0.12164F, 0.06059F}},
    BoneRotation{Bone::spine, {0.99414F, 0.02071F, -0.08856F, -0.05852F}},
    BoneRotation{Bone::chest, {0.99559F, -0.00304F, -0.0871F, -0.03477F}},
    BoneRotation{Bone::upper_chest, {0.99829F, -0.00137F, -0.05232F, -0.02614F}},
    BoneRotation{Bone::neck, {0.99939F, 0.0F, 0.0F, 0.0349F}},
    BoneRotation{Bone::head, {0.99194F, 0.00425F, 0.1218F, 0.03464F}},
    BoneRotation{Bone::left_upper_leg, {0.97207F, -0.22255F, 0.06207F, -0.04113F}},
    BoneRotation{Bone::left_lower_leg, {0.98769F, 0.15643F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_foot, {0.99692F, 0.07846F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_upper_arm, {0.86995F, 0.0168F, 0.06424F, -0.48865F}},
    BoneRotation{Bone::left_lower_arm, {0.71934F, 0.0F, -0.69466F, 0.0F}},
    BoneRotation{Bone::left_hand, {0.98106F, -0.17299F, -0.01513F, -0.08583F}},
    BoneRotation{Bone::right_upper_leg, {0.9817F, 0.12785F, -0.08977F, -0.10887F}},
    BoneRotation{Bone::right_lower_leg, {0.96593F, 0.25882F, 0.0F, 0.0F}},
    BoneRotation{Bone::right_foot, {0.99452F, 0.10453F, 0.0F, 0.0F}},
    BoneRotation{Bone::right_toes, {0.96593F, -0.25882F, 0.0F, 0.0F}},
    BoneRotation{Bone::right_upper_arm, {0.84313F, 0.25974F, 0.30189F, 0.36128F}},
    BoneRotation{Bone::right_lower_arm, {0.67559F, 0.0F, 0.73728F, 0.0F}},
    BoneRotation{Bone::right_hand, {0.96063F, 0.2574F, -0.02705F, 0.10097F}},
};
// Deep squat: thighs raised by 120 degrees, knees bent by 128.
constexpr std::array kSquat = {
    BoneRotation{Bone::hips, {0.99452F, 0.10453F, 0.0F, 0.0F}},
    BoneRotation{Bone::spine, {0.99255F, 0.12187F, 0.0F, 0.0F}},
    BoneRotation{Bone::chest, {0.99619F, 0.08716F, 0.0F, 0.0F}},
    BoneRotation{Bone::head, {0.99255F, -0.12187F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_upper_leg, {0.50267F, -0.84433F, 0.12196F, 0.13987F}},
    BoneRotation{Bone::left_lower_leg, {0.43837F, 0.89879F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_foot, {0.98163F, -0.19081F, 0.0F, 0.0F}},
    BoneRotation{Bone::left_upper_arm, {0.76313F, 0.05602F, -0.64034F, -0.06677F}},
    BoneRotation{Bone::left_lower_arm, {0.98481F, 0.0F, -0.17365F, 0.0F}},
};
// Trunk turned against the hips, forearms bent, hands rolled by 80 degrees.
constexpr std::array kTwist = {
    BoneRotation{Bone::hips, {0.99452F, 0.0F, -0.10453F, 0.0F}},
    BoneRotation{Bone::spine, {0.98769F, 0.0F, 0.15643F, 0.0F}},
    BoneRotation{Bone::chest, {0.98769F, 0.0F, 0.15643F, 0.0F}},
    BoneRotation{Bone::upper_chest, {0.98769F, 0.0F, 0.15643F, 0.0F}},
    BoneRotation{Bone::neck, {0.98481F, 0.0F, 0.17365F, 0.0F}},
    BoneRotation{Bone::head, {0.9763F, 0.0F, 0.21644F, 0.0F}},
    BoneRotation{Bone::left_upper_leg, {0.99452F, 0.0F, 0.0F, 0.10453F}},
    BoneRotation{Bone::left_foot, {0.99452F, 0.0F, 0.0F, -0.10453F}},
    BoneRotation{Bone::left_upper_arm, {0.88302F, 0.32139F, -0.11698F, -0.32139F}},
    BoneRotation{Bone::left_lower_arm, {0.76604F, 0.0F, -0.64279F, 0.0F}},
    BoneRotation{Bone::left_hand, {0.76604F, 0.64279F, 0.0F, 0.0F}},
    BoneRotation{Bone::right_upper_leg, {0.99452F, 0.0F, 0.0F, -0.10453F}},
    BoneRotation{Bone::right_foot, {0.99452F, 0.0F, 0.0F, 0.10453F}},
    BoneRotation{Bone::right_upper_arm, {0.88302F, 0.32139F, 0.11698F, 0.32139F}},
    BoneRotation{Bone::right_lower_arm, {0.76604F, 0.0F, 0.64279F, 0.0F}},
    BoneRotation{Bone::right_hand, {0.76604F, -0.64279F, 0.0F, 0.0F}},
};
// Left hand rolled by 120 degrees about the forearm, which its twist helper must take half of.
constexpr std::array kWristBend = {
    BoneRotation{Bone::left_hand, {0.5F, 0.86603F, 0.0F, 0.0F}},
};

/// The rotation seen in a mirror at x = 0.
glm::quat mirror_image(const glm::quat& q) noexcept { return {q.w, q.x, -q.y, -q.z}; }

/// The rest pose with some bones turned.
Pose posed(std::span<const BoneRotation> rotations) noexcept {
    Pose pose;
    for (const BoneRotation& entry : rotations) {
        pose.rotation(entry.bone) = glm::normalize(entry.rotation);
    }
    return pose;
}

/// As given on the left side and in the middle, and mirrored on the right.
Pose posed_on_both_sides(std::span<const BoneRotation> rotations) noexcept {
    Pose pose = posed(rotations);
    for (const BoneRotation& entry : rotations) {
        const Bone other = motion::mirrored(entry.bone);
        if (other != entry.bone) {
            pose.rotation(other) = mirror_image(pose.rotation(entry.bone));
        }
    }
    return pose;
}

/// Bends the fingers of one hand, the outer ones more, and the thumb's two outer joints; degrees.
void curl_fingers(Side side, float curl, float thumb, Pose& pose) noexcept {
    const auto bend = [&](Bone left_bone, glm::vec3 axis, float degrees) {
        const float half = 0.5F * glm::radians(degrees);
        const glm::quat left(std::cos(half), std::sin(half) * axis);
        pose.rotation(motion::on_side(left_bone, side)) =
            side == Side::left ? left : mirror_image(left);
    };
    constexpr std::array kBases = {Bone::left_index_proximal,
                                   Bone::left_middle_proximal,
                                   Bone::left_ring_proximal,
                                   Bone::left_little_proximal};
    constexpr std::array kShares = {0.9F, 1.1F, 0.7F};  // of the three joints
    constexpr glm::vec3 kFingerAxis{0.0F, 0.0F, -1.0F};
    for (std::size_t finger = 0; finger < kBases.size(); ++finger) {
        // The little finger curls most, as in a relaxed hand.
        const float degrees = curl * (1.0F + 0.06F * static_cast<float>(finger));
        for (std::size_t joint = 0; joint < kShares.size(); ++joint) {
            const auto bone = static_cast<Bone>(motion::index_of(kBases[finger]) + joint);
            bend(bone, kFingerAxis, degrees * kShares[joint]);
        }
    }
    constexpr glm::vec3 kThumbAxis{0.0F, -0.70711F, -0.70711F};
    bend(Bone::left_thumb_proximal, kThumbAxis, thumb);
    bend(Bone::left_thumb_distal, kThumbAxis, thumb);
}

/// Curls the fingers of both hands alike.
Pose with_hands(Pose pose, float curl, float thumb) noexcept {
    for (const Side side : motion::kSides) {
        curl_fingers(side, curl, thumb, pose);
    }
    return pose;
}

/// The bind pose with the hips at the origin, as all test poses have them.
Pose bind() noexcept {
    Pose pose = mannequin_bind_pose();
    pose.hips_position = {};
    return pose;
}

/// The hands differ, as the rest of the pose does.
Pose side_step() noexcept {
    Pose pose = posed(kSideStep);
    curl_fingers(Side::left, 22.0F, 20.0F, pose);
    curl_fingers(Side::right, 18.0F, 18.0F, pose);
    return pose;
}

std::array<NamedPose, 12> make_poses() {
    return {{
        {"T", Pose{}},
        {"bind", bind()},
        {"cross", with_hands(posed(kCross), 75.0F, 40.0F)},
        {"down", with_hands(posed_on_both_sides(kDown), 14.0F, 15.0F)},
        {"elbow", posed(kElbowBend)},
        {"hip", posed(kHipBend)},
        {"knee", posed(kKneeBend)},
        {"over", with_hands(posed_on_both_sides(kOver), 10.0F, 15.0F)},
        {"side_step", side_step()},
        {"squat", with_hands(posed_on_both_sides(kSquat), 12.0F, 15.0F)},
        {"twist", with_hands(posed(kTwist), 16.0F, 15.0F)},
        {"wrist", posed(kWristBend)},
    }};
}

}  // namespace

std::span<const NamedPose> mannequin_test_poses() {
    static const std::array<NamedPose, 12> poses = make_poses();
    return poses;
}

const Pose& mannequin_test_pose(std::string_view name) {
    const auto poses = mannequin_test_poses();
    const auto found = std::find_if(
        poses.begin(), poses.end(), [&](const NamedPose& named) { return named.name == name; });
    RAKS_ASSERT(found != poses.end());
    return found->pose;
}

}  // namespace raks::render
