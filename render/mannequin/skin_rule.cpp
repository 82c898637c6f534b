#include <algorithm>
#include <cmath>
#include <limits>

#include "base/smooth_steps.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/skin_weights.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using motion::Bone;

/// At a joint the share s = smootherstep(from, to, signed distance to the plane) goes to the child.
struct Split {
    Bone joint;
    glm::vec3 normal;  // bind pose, toward the child
    float from;        // metres
    float to;
};

// Index of a split in `kSplits`.
enum SplitIndex : std::size_t {
    kShoulder,
    kHip,
    kElbow,
    kWrist,
    kKnee,
    kAnkle,
    kToes,
    kHeadSplit,
    kNeck,
    kUpperChest,
    kChest,
    kSpine,
    kSplitCount
};

// Planes lie askew to the bones, along the folds of armpit, groin and neck, and are wide where the
// flesh is thick.
constexpr std::array<Split, kSplitCount> kSplits = {{
    {Bone::left_upper_arm, {0.90648F, -0.42221F, -0.00564F}, -0.080F, 0.120F},
    {Bone::left_upper_leg, {0.42349F, -0.86714F, 0.26216F}, -0.075F, 0.070F},
    {Bone::left_lower_arm, {0.71536F, -0.69081F, 0.10507F}, -0.045F, 0.045F},
    {Bone::left_hand, {0.70362F, -0.67948F, 0.20791F}, -0.028F, 0.018F},
    {Bone::left_lower_leg, {0.09683F, -0.99215F, -0.07915F}, -0.060F, 0.060F},
    {Bone::left_foot, {0.06334F, -0.98461F, 0.16286F}, -0.030F, 0.026F},
    {Bone::left_toes, {0.01089F, -0.14777F, 0.98896F}, -0.022F, 0.022F},
    {Bone::head, {0.0F, 0.94386F, 0.33035F}, -0.030F, 0.038F},
    {Bone::neck, {0.0F, 0.99288F, 0.11915F}, -0.040F, 0.036F},
    {Bone::upper_chest, {0.0F, 1.0F, 0.0F}, -0.055F, 0.055F},
    {Bone::chest, {0.0F, 1.0F, 0.0F}, -0.055F, 0.055F},
    {Bone::spine, {0.0F, 1.0F, 0.0F}, -0.050F, 0.050F},
}};

/// Weights at a joint with a helper: over the first half of the step s the parent's weight goes to
/// the helper, over the second half the helper's to the child. Their sum is 1.
struct Thirds {
    float parent;
    float helper;
    float child;
};
Thirds through_helper(float s) noexcept {
    return {std::max(0.0F, 1.0F - 2.0F * s),
            1.0F - std::abs(2.0F * s - 1.0F),
            std::max(0.0F, 2.0F * s - 1.0F)};
}

/// Weight of a bone or helper, to read or set.
float& share_of(JointShares& shares, Bone bone) noexcept { return shares[motion::index_of(bone)]; }
float& share_of(JointShares& shares, Helper helper) noexcept {
    return shares[static_cast<std::size_t>(helper)];
}

/// How far along a bone, 0 at its own joint, 1 at the next.
float fraction_along(glm::vec3 p, glm::vec3 from, glm::vec3 to) noexcept {
    const glm::vec3 along = to - from;
    return glm::dot(p - from, along) / glm::dot(along, along);
}

// One finger with its three bones in a row.
struct Finger {
    Group group;
    Bone base;         // the next two bones follow it
    glm::vec3 along;   // T-pose
    float base_width;  // metres, of the step at the base joint
    float palm_from;   // own distance at which the palm takes over
    float palm_to;
};
constexpr glm::vec3 kX{1.0F, 0.0F, 0.0F};
// Half widths of the transitions at the finger joints, metres.
constexpr float kBaseWidth = 0.009F;
constexpr float kJointWidth = 0.006F;
constexpr std::array<Finger, 5> kFingers = {{
    {Group::thumb,
     Bone::left_thumb_metacarpal,
     {0.7582F, -0.2022F, 0.6268F},
     0.016F,
     -0.002F,
     0.012F},
    {Group::index, Bone::left_index_proximal, kX, kBaseWidth, 0.0F, 0.010F},
    {Group::middle, Bone::left_middle_proximal, kX, kBaseWidth, 0.0F, 0.010F},
    {Group::ring, Bone::left_ring_proximal, kX, kBaseWidth, 0.0F, 0.010F},
    {Group::little, Bone::left_little_proximal, kX, kBaseWidth, 0.0F, 0.010F},
}};

}  // namespace

/// Share that passes a joint's plane toward the child, 0..1.
float SkinRule::passed_at(std::size_t split, glm::vec3 p) const noexcept {
    const Split& s = kSplits[split];
    return smootherstep(s.from, s.to, glm::dot(p - frames_.joint(s.joint), s.normal));
}

/// Keeps the arm's share off the trunk beside it: the shoulder's plane goes on through the chest,
/// where the trunk is the nearer body part. 1 on the arm, 0 on the trunk.
float SkinRule::arm_mask(glm::vec3 p, float d_body, float d_arm) const noexcept {
    constexpr float kClearlyArm = 0.14F;  // metres from the shoulder
    const glm::vec3 shoulder = frames_.joint(Bone::left_upper_arm);
    const glm::vec3 along = glm::normalize(frames_.joint(Bone::left_lower_arm) - shoulder);
    if (d_arm < d_body && glm::dot(p - shoulder, along) > kClearlyArm) {
        return 1.0F;
    }
    return smootherstep(-0.03F, 0.03F, d_body - d_arm);
}

/// Weights of collar helper, upper arm, forearm and hand; returns what the arm leaves to the trunk.
float SkinRule::add_arm(glm::vec3 p,
                        float d_body,
                        float d_arm,
                        JointShares& shares) const noexcept {
    const float s = passed_at(kShoulder, p) * arm_mask(p, d_body, d_arm);
    if (s <= 0.0F) {
        return 1.0F;
    }
    const Thirds shoulder = through_helper(s);
    share_of(shares, Helper::left_shoulder_half) = shoulder.helper;
    if (shoulder.child <= 0.0F) {
        return shoulder.parent;
    }
    const glm::vec3 shoulder_joint = frames_.joint(Bone::left_upper_arm);
    const glm::vec3 elbow_joint = frames_.joint(Bone::left_lower_arm);
    const glm::vec3 wrist_joint = frames_.joint(Bone::left_hand);

    // Twist helpers: the upper arm's roll grows from shoulder to elbow, the forearm's from elbow to
    // wrist, so that neither wrings at one joint.
    const Thirds elbow = through_helper(passed_at(kElbow, p));
    const float upper = shoulder.child * elbow.parent;
    const float upper_twist =
        1.0F - smootherstep(0.35F, 0.80F, fraction_along(p, shoulder_joint, elbow_joint));
    share_of(shares, Helper::left_upper_arm_twist) = upper * upper_twist;
    share_of(shares, Bone::left_upper_arm) = upper * (1.0F - upper_twist);
    share_of(shares, Helper::left_elbow_half) = shoulder.child * elbow.helper;

    const float wrist = passed_at(kWrist, p);
    const float lower = shoulder.child * elbow.child;
    const float forearm = lower * (1.0F - wrist);
    const float lower_twist =
        smootherstep(0.15F, 0.60F, fraction_along(p, elbow_joint, wrist_joint));
    share_of(shares, Helper::left_lower_arm_twist) = forearm * lower_twist;
    share_of(shares, Bone::left_lower_arm) = forearm * (1.0F - lower_twist);
    add_hand(p, lower * wrist, shares);
    return shoulder.parent;
}

/// Deals `rest` out to the nearest finger, from the tip inward, and the remainder to the hand.
void SkinRule::add_hand(glm::vec3 p, float rest, JointShares& shares) const noexcept {
    if (rest <= 0.0F) {
        return;
    }
    const Finger* nearest = &kFingers[0];
    float distance = std::numeric_limits<float>::max();
    for (const Finger& finger : kFingers) {
        const float own = field_.finger(finger.group, p);
        if (own < distance) {
            distance = own;
            nearest = &finger;
        }
    }
    for (int phalanx = 2; phalanx >= 0; --phalanx) {
        const Bone bone = static_cast<Bone>(static_cast<int>(nearest->base) + phalanx);
        const float width = phalanx == 0 ? nearest->base_width : kJointWidth;
        const glm::vec3 along = frames_.direction(bone, nearest->along);
        float s = smootherstep(-width, width, glm::dot(p - frames_.joint(bone), along));
        // At the knuckles the palm's skin comes near the finger's base and stays with the hand.
        if (phalanx == 0) {
            s *= 1.0F - smootherstep(nearest->palm_from, nearest->palm_to, distance);
        }
        share_of(shares, bone) = rest * s;
        rest *= 1.0F - s;
    }
    share_of(shares, Bone::left_hand) = rest;
}

/// Weights of hip helper, thigh, shank and foot from `share`; returns what is left to the trunk.
/// `nearer_than_core`: by how many metres the leg is nearer than the trunk.
float SkinRule::add_leg(glm::vec3 p,
                        float share,
                        float nearer_than_core,
                        JointShares& shares) const noexcept {
    constexpr float kCrotch = 0.80F;  // height below which the legs are apart
    const bool is_clearly_leg = p.y < kCrotch && nearer_than_core > 0.02F;
    // The hip's tilted plane would cut through the inner thigh farther down: there all is leg.
    const Thirds hip = through_helper(is_clearly_leg ? 1.0F : passed_at(kHip, p));
    // Near the middle both legs hold the skin, so that nothing tears between them.
    const float own = p.y > kCrotch ? 0.5F + 0.5F * smootherstep(0.0F, 0.018F, p.x) : 1.0F;

    const Thirds knee = through_helper(passed_at(kKnee, p));
    const float thigh = share * hip.child * knee.parent;
    // Like the upper arm's: the thigh's roll comes in gradually from hip to knee.
    const float twist =
        thigh * (1.0F - smootherstep(0.30F,
                                     0.80F,
                                     fraction_along(p,
                                                    frames_.joint(Bone::left_upper_leg),
                                                    frames_.joint(Bone::left_lower_leg))));
    share_of(shares, Helper::left_hip_half) = share * hip.helper * own;
    share_of(shares, Helper::right_hip_half) = share * hip.helper * (1.0F - own);
    share_of(shares, Helper::left_upper_leg_twist) = twist * own;
    share_of(shares, Helper::right_upper_leg_twist) = twist * (1.0F - own);
    share_of(shares, Bone::left_upper_leg) = thigh - twist;
    share_of(shares, Helper::left_knee_half) = share * hip.child * knee.helper;

    const float below_knee = share * hip.child * knee.child;
    const float ankle = passed_at(kAnkle, p);
    const float toes = passed_at(kToes, p);
    share_of(shares, Bone::left_lower_leg) = below_knee * (1.0F - ankle);
    share_of(shares, Bone::left_foot) = below_knee * ankle * (1.0F - toes);
    share_of(shares, Bone::left_toes) = below_knee * ankle * toes;
    return share * hip.parent;
}

/// Deals `rest` out from head to hips: each plane takes what lies above it.
void SkinRule::add_trunk(glm::vec3 p, float rest, JointShares& shares) const noexcept {
    for (const std::size_t split : {kHeadSplit, kNeck, kUpperChest, kChest, kSpine}) {
        const float s = passed_at(split, p);
        share_of(shares, kSplits[split].joint) += rest * s;
        rest *= 1.0F - s;
    }
    share_of(shares, Bone::hips) += rest;
    float& upper_chest = share_of(shares, Bone::upper_chest);
    // The outer upper corner of the chest rises with the collar bone.
    const float collar =
        upper_chest * smootherstep(0.03F, 0.125F, p.x) * smootherstep(1.285F, 1.375F, p.y);
    share_of(shares, Bone::left_shoulder) += collar;
    upper_chest -= collar;
}

/// Whatever the arm leaves goes to the leg, whatever the leg leaves to the trunk: the sum stays 1.
JointShares SkinRule::at(glm::vec3 p) const noexcept {
    constexpr float kNoLegAbove = 1.1F;
    JointShares shares{};
    const float d_core = field_.core(p);
    const float d_leg = field_.leg(p);
    const float d_arm = field_.arm(p);
    const float d_body = std::min(d_core, d_leg);
    float rest = add_arm(p, d_body, d_arm, shares);
    if (p.y < kNoLegAbove && d_body <= d_arm) {
        rest = add_leg(p, rest, d_core - d_leg, shares);
    }
    add_trunk(p, rest, shares);
    return shares;
}

}  // namespace raks::render
