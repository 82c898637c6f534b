#include "motion/dance/couple_grips.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/elbow.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kSmallestLength = 1e-6F;
constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 kForward{0.0F, 0.0F, 1.0F};
// Of the palm, in the frame of either hand.
constexpr glm::vec3 kPalmNormal{0.0F, -1.0F, 0.0F};

// Between the middles of two palms that hold one another; metres.
constexpr float kPalms = 0.02F;
// Shortest distance of a wrist from its shoulder, of the arm's length (elbow bent by 127 degrees),
// and that limit's softness; the longest (elbow bent by 26 degrees), and its softness. Nearer the
// elbow would fly round, farther it would snap straight.
constexpr float kNearest = 0.45F;
constexpr float kNearestSoftly = 0.2F;
constexpr float kFarthest = 0.975F;
constexpr float kFarthestSoftly = 0.08F;
constexpr int kMeetingRounds = 3;    // to a point that both arms reach
constexpr int kReachRounds = 3;      // the palm turns with the forearm, so one round falls short
constexpr float kMostWrist = 1.05F;  // radians that a grip turns a wrist

// Comfort: distances between the two shoulders, of both arms' lengths together.
constexpr float kStretched = 1.0F;  // beyond it nothing is held
constexpr float kReached = 0.86F;   // up to it all is
// Distances of the meeting point from a shoulder, of the arm's length.
constexpr float kAtShoulder = 0.3F;
constexpr float kClearOfShoulder = 0.65F;
// Metres before the shoulders' plane from which a point counts as behind, and as before its owner.
constexpr float kBehind = -0.16F;
constexpr float kBefore = 0.04F;
constexpr float kOverHead = 0.2F;  // metres over the shoulders: there, behind does not matter
constexpr float kWellOverHead = 0.4F;

// Closed frame. The hands are so far beside the middle of the two shoulders; of an arm's length.
constexpr float kFrameAside = 0.7F;
// Height of the eyes over the head's joint, of that of the head's middle.
constexpr float kEyesOfHead = 0.6F;
// Places of the partner's body that palms lie on, of the left side: shares of the girth of the
// trunk's flanks, and metres of a body as large as the mannequin.
constexpr float kBladeAside = 1.6F;     // of the way from the trunk's middle to that of a flank
constexpr float kBladeUp = -0.03F;      // from the upper chest's joint
constexpr float kWaistUp = 0.1F;        // from the hips' joint
constexpr float kArmShare = 0.5F;       // from shoulder to elbow
constexpr float kArmThickness = 0.06F;  // from the upper arm's bone to a palm's middle
constexpr float kShoulderThickness = 0.05F;
// Outward, up and ahead of its own trunk: where the elbow of a hand that lies on the partner is.
constexpr glm::vec3 kElbowOut{1.0F, 0.15F, 0.0F};
constexpr float kElbowShare = 0.8F;  // of the way there
// The same of joined hands: elbows hang a little.
constexpr glm::vec3 kElbowDown{0.5F, -1.0F, -0.2F};

constexpr float kUsualArm = 0.53F;  // metres; the mannequin's

std::optional<LaidHand> laid_of(const ClosedFrame* frame, std::size_t role, Side side) noexcept {
    return frame != nullptr ? frame->laid[role][static_cast<std::size_t>(side)] : std::nullopt;
}

glm::vec3 direction(const glm::vec3& vector, const glm::vec3& otherwise) noexcept {
    const float length = glm::length(vector);
    return length > kSmallestLength ? vector / length : otherwise;
}

}  // namespace

/// One hand of one of the two, and what it is to hold.
struct CoupleGrips::Hand {
    Pose* pose = nullptr;
    const Body* body = nullptr;
    Side side = Side::left;
    Limb arm;
    glm::vec3 palm{};     // as danced
    glm::vec3 wrist{};    // as danced
    glm::quat danced{};   // local rotation of the hand, as danced
    glm::vec3 target{};   // sum over its grips, weighted
    glm::vec3 normal{};   // of the palm, likewise
    float weight = 0.0F;  // sum
    float clasps = 0.0F;  // of it, of palms
    glm::quat trunk{};    // rotation of the upper chest

    Hand() = default;
    Hand(Pose& of, const Body& its_body, const WorldPose& world, Side on)
        : pose(&of),
          body(&its_body),
          side(on),
          arm(arm_of(world, on)),
          palm(palm_of(world, on)),
          wrist(world.position(arm.end)),
          danced(of.rotation(arm.end)),
          trunk(world.rotation(Bone::upper_chest)) {}

    void add(const glm::vec3& point, const glm::vec3& facing, float share) noexcept {
        target += share * point;
        normal += share * facing;
        weight += share;
    }
};

/// Both, with the hands by Side.
struct CoupleGrips::Couple {
    std::array<Hand, 2> lead;
    std::array<Hand, 2> follow;
    const WorldPose& lead_world;
    const WorldPose& follow_world;
};

CoupleGrips::Body::Body(const Skeleton& of)
    : skeleton(of),
      arm_length(glm::length(of.offsets[index_of(Bone::left_lower_arm)]) +
                 glm::length(of.offsets[index_of(Bone::left_hand)])) {}

CoupleGrips::CoupleGrips(const Skeleton& lead, const Skeleton& follow)
    : lead_(lead), follow_(follow) {
    for (const Side side : kSides) {
        set_hand_shape(side, 0.5, clasp_);
        set_hand_shape(side, 0.12, rest_);
    }
}

namespace {

/// Whether a point lies where its owner can hold it: before the body, or over the head.
float before(const WorldPose& world, const glm::vec3& point) noexcept {
    const glm::vec3 shoulders =
        0.5F * (world.position(Bone::left_upper_arm) + world.position(Bone::right_upper_arm));
    const glm::vec3 local = glm::conjugate(world.rotation(Bone::upper_chest)) * (point - shoulders);
    return std::max(smootherstep(kBehind, kBefore, local.z),
                    smootherstep(kOverHead, kWellOverHead, local.y));
}

}  // namespace

GripWeights CoupleGrips::comfort(const ClosedFrame* frame,
                                 const WorldPose& lead,
                                 const WorldPose& follow) const noexcept RAKS_NONBLOCKING {
    const float arms = lead_.arm_length + follow_.arm_length;
    GripWeights comfort{};
    for (const Side own : kSides) {
        for (const Side other : kSides) {
            const glm::vec3& a = lead.position(on_side(Bone::left_upper_arm, own));
            const glm::vec3& b = follow.position(on_side(Bone::left_upper_arm, other));
            const glm::vec3 middle = 0.5F * (palm_of(lead, own) + palm_of(follow, other));
            const float apart = glm::distance(a, b) / arms;
            const auto clear_of = [&](const glm::vec3& shoulder, const Body& body) {
                return smootherstep(kAtShoulder,
                                    kClearOfShoulder,
                                    glm::distance(middle, shoulder) / body.arm_length);
            };
            float& here = comfort[index_of(palms(own, other))];
            here = 1.0F - smootherstep(kReached, kStretched, apart);
            if (frame == nullptr) {
                here *= clear_of(a, lead_) * clear_of(b, follow_) * before(lead, middle) *
                        before(follow, middle);
            }
        }
    }
    const float chests =
        glm::distance(lead.position(Bone::upper_chest), follow.position(Bone::upper_chest));
    std::fill(comfort.begin() + kPalmPairs,
              comfort.end(),
              1.0F - smootherstep(0.6F * arms, 0.85F * arms, chests));
    return comfort;
}

namespace {

/// The wrist's target, limited to the distances that its own arm reaches comfortably.
glm::vec3 within_reach(const Limb& arm, float length, const glm::vec3& target) noexcept {
    const glm::vec3 line = target - arm.root;
    const float reach = glm::length(line);
    if (reach < kSmallestLength) {
        return target;
    }
    const float held = soft_max(reach, kNearest * length, kNearestSoftly * length);
    return arm.root -
           line * (soft_max(-held, -kFarthest * length, kFarthestSoftly * length) / reach);
}

}  // namespace

// Turns the hand to its normal and brings its palm to its target, in rounds, as each turns with the
// other.
void CoupleGrips::reach(Hand& hand) const noexcept {
    const float share = std::min(hand.weight, 1.0F);
    if (share <= 0.0F) {
        return;
    }
    Pose& pose = *hand.pose;
    const glm::vec3 target = hand.target / hand.weight;
    const glm::vec3 normal = direction(hand.normal, kUp);
    const glm::vec3 middle =
        0.5F *
        hand.body->skeleton.offsets[index_of(on_side(Bone::left_middle_proximal, hand.side))];
    for (int round = 0; round < kReachRounds; ++round) {
        const glm::quat upper = hand.arm.parent * pose.rotation(hand.arm.upper);
        const glm::quat lower = upper * pose.rotation(hand.arm.lower);
        const glm::quat wrist = lower * hand.danced;
        // The turn grows as the sine of what is missing: a palm that faces the other way is left as
        // it is, as neither way round is the shorter one.
        const glm::vec3 turn = kMostWrist * share * glm::cross(wrist * kPalmNormal, normal);
        const float angle = std::max(glm::length(turn), kSmallestLength);
        pose.rotation(hand.arm.end) =
            glm::normalize(glm::conjugate(lower) * glm::angleAxis(angle, turn / angle) * wrist);
        const glm::vec3 from_wrist = lower * pose.rotation(hand.arm.end) * middle;
        // The limit is mixed in with the share, too: an arm that begins to hold must not leap.
        const glm::vec3 held = within_reach(hand.arm, hand.body->arm_length, target - from_wrist);
        solve_limb(hand.body->skeleton, hand.arm, glm::mix(hand.wrist, held, share), pose);
    }
    const float clasp = hand.clasps / hand.weight;
    // A hand's bones follow it in a row.
    constexpr std::size_t kFingerBones = 15;
    const std::size_t first = index_of(hand.arm.end) + 1;
    for (std::size_t i = first; i < first + kFingerBones; ++i) {
        const glm::quat shape =
            interpolate(rest_.local_rotations[i], clasp_.local_rotations[i], clasp);
        pose.local_rotations[i] = interpolate(pose.local_rotations[i], shape, share);
    }
}

// Beside the couple, on the lead's left.
glm::vec3 CoupleGrips::frame_point(const ClosedFrame& frame, const Couple& couple) const noexcept {
    glm::vec3 between = couple.follow_world.position(Bone::upper_chest) -
                        couple.lead_world.position(Bone::upper_chest);
    between.y = 0.0F;
    const glm::vec3 aside = glm::cross(kUp, direction(between, kForward));
    glm::vec3 point = 0.5F * (couple.lead[static_cast<std::size_t>(Side::left)].arm.root +
                              couple.follow[static_cast<std::size_t>(Side::right)].arm.root);
    point += kFrameAside * 0.5F * (lead_.arm_length + follow_.arm_length) * aside;
    const glm::vec3 eyes{0.0F, kEyesOfHead * follow_.skeleton.girth.head_height, 0.0F};
    point.y = static_cast<float>(frame.clasp) * couple.follow_world.point(Bone::head, eyes).y;
    return point;
}

/// A place of the partner that a palm lies on.
struct CoupleGrips::Spot {
    glm::vec3 palm{};    // where the palm's middle is to be
    glm::vec3 facing{};  // what it faces

    /// `pose`: the partner's, its arms as they are by now.
    Spot(const LaidHand& laid, const Body& of, const WorldPose& world, const Pose& pose) noexcept {
        const Girth& girth = of.skeleton.girth;
        const float size = of.arm_length / kUsualArm;
        const float sign = laid.side == Side::left ? 1.0F : -1.0F;
        const glm::quat& chest = world.rotation(Bone::upper_chest);
        switch (laid.on) {
            case HoldPlace::shoulder_blade:
                palm = world.point(Bone::upper_chest,
                                   {sign * kBladeAside * girth.flank,
                                    kBladeUp * size,
                                    girth.trunk_ahead - girth.trunk - girth.hand});
                facing = chest * kForward;
                return;
            case HoldPlace::waist:
                palm = world.point(Bone::hips,
                                   {sign * (girth.flank + girth.trunk + girth.hand),
                                    kWaistUp * size,
                                    girth.trunk_ahead});
                facing = world.rotation(Bone::hips) * glm::vec3(-sign, 0.0F, 0.0F);
                return;
            case HoldPlace::shoulder:
                palm = world.position(on_side(Bone::left_upper_arm, laid.side)) +
                       kShoulderThickness * size * kUp;
                facing = -kUp;
                return;
            case HoldPlace::upper_arm:
                break;
        }
        const Limb arm = arm_of(world, laid.side);
        const glm::vec3 bone =
            arm.parent * pose.rotation(arm.upper) * of.skeleton.offsets[index_of(arm.lower)];
        const glm::vec3 along = direction(bone, kForward);
        const glm::vec3 out = chest * glm::vec3(0.7F * sign, 0.7F, 0.0F);
        facing = -direction(out - along * glm::dot(out, along), kUp);
        palm = arm.root + kArmShare * bone - kArmThickness * size * facing;
    }
};

/// Gives all hands that hold hands what they reach for.
void CoupleGrips::join(const GripWeights& weights,
                       const ClosedFrame* frame,
                       Couple& couple) const noexcept {
    for (Hand& own : couple.lead) {
        for (Hand& other : couple.follow) {
            const Grip grip = palms(own.side, other.side);
            const float weight = weights[index_of(grip)];
            if (weight <= 0.0F) {
                continue;
            }
            const bool is_frame = frame != nullptr && grip == Grip::left_right;
            glm::vec3 meeting =
                is_frame ? frame_point(*frame, couple) : 0.5F * (own.palm + other.palm);
            for (int round = 0; round < kMeetingRounds; ++round) {
                meeting = within_reach(own.arm, lead_.arm_length, meeting);
                meeting = within_reach(other.arm, follow_.arm_length, meeting);
            }
            // His palm is offered from below, hers lies on it; in the frame they face each other.
            const glm::vec3 across = direction(other.arm.root - own.arm.root, kForward);
            const glm::vec3 facing = direction(across + (is_frame ? 0.3F : 0.9F) * kUp, kUp);
            own.add(meeting - 0.5F * kPalms * facing, facing, weight);
            other.add(meeting + 0.5F * kPalms * facing, -facing, weight);
            own.clasps += weight;
            other.clasps += weight;
        }
    }
}

void CoupleGrips::hold(const GripWeights& weights,
                       const ClosedFrame* frame,
                       const WorldPose& lead_world,
                       const WorldPose& follow_world,
                       Pose& lead,
                       Pose& follow) const noexcept RAKS_NONBLOCKING {
    if (std::all_of(weights.begin(), weights.end(), [](float one) { return one <= 0.0F; })) {
        return;
    }
    Couple couple{
        {Hand(lead, lead_, lead_world, Side::left), Hand(lead, lead_, lead_world, Side::right)},
        {Hand(follow, follow_, follow_world, Side::left),
         Hand(follow, follow_, follow_world, Side::right)},
        lead_world,
        follow_world};
    join(weights, frame, couple);
    const auto aim = [](const Hand& hand, const glm::vec3& left, float weight) {
        const glm::vec3 own = hand.side == Side::left ? left : left * glm::vec3(-1.0F, 1.0F, 1.0F);
        turn_elbow(
            hand.body->skeleton, hand.arm, hand.trunk * own, kElbowShare * weight, *hand.pose);
    };
    const auto lay = [&](std::size_t role, const Spot& spot, Hand& hand) {
        const float weight = weights[index_of(laid(role, hand.side))];
        aim(hand, kElbowOut, weight);
        hand.add(spot.palm, spot.facing, weight);
    };
    if (frame != nullptr) {
        const float joined = weights[index_of(Grip::left_right)];
        aim(couple.lead[static_cast<std::size_t>(Side::left)], kElbowDown, joined);
        aim(couple.follow[static_cast<std::size_t>(Side::right)], kElbowDown, joined);
    }
    for (Hand& hand : couple.lead) {
        if (const auto at = laid_of(frame, 0, hand.side)) {
            lay(0, Spot(*at, follow_, follow_world, follow), hand);
        }
        reach(hand);
    }
    // His arms are where hers lie on them only now.
    for (Hand& hand : couple.follow) {
        if (const auto at = laid_of(frame, 1, hand.side)) {
            lay(1, Spot(*at, lead_, lead_world, lead), hand);
        }
        reach(hand);
    }
}

namespace {

constexpr float kMostYaw = 1.0F;     // radians of a head against the chest, soft limit
constexpr float kMostPitch = 0.35F;  // radians
// Radians from ahead: up to the first the partner is looked at, beyond the second no more.
constexpr float kSeen = 1.3F;
constexpr float kOutOfSight = 2.3F;
constexpr float kNeckShare = 0.4F;
constexpr float kPastPitch = 0.06F;  // radians up, over the partner's shoulder

struct Look {
    float yaw = 0.0F;    // to the left
    float pitch = 0.0F;  // up
};

Look look_of(const glm::vec3& local) noexcept {
    return {std::atan2(local.x, local.z), std::atan2(local.y, std::hypot(local.x, local.z))};
}

void turn_head(float share, const WorldPose& own, const Look& wanted, Pose& pose) noexcept {
    const glm::quat back = glm::conjugate(own.rotation(Bone::upper_chest));
    const Look now = look_of(back * (own.rotation(Bone::head) * kForward));
    const float yaw = share * (kMostYaw * std::tanh(wanted.yaw / kMostYaw) - now.yaw);
    const float pitch = share * (kMostPitch * std::tanh(wanted.pitch / kMostPitch) - now.pitch);
    const auto turn = [&](Bone bone, float part) {
        // About x, a positive angle nods.
        pose.rotation(bone) = glm::normalize(
            glm::angleAxis(part * yaw, kUp) *
            glm::angleAxis(-part * pitch, glm::vec3(1.0F, 0.0F, 0.0F)) * pose.rotation(bone));
    };
    turn(Bone::neck, kNeckShare);
    turn(Bone::head, 1.0F - kNeckShare);
}

void look_at(float share, const WorldPose& own, const glm::vec3& partner, Pose& pose) noexcept {
    const glm::quat back = glm::conjugate(own.rotation(Bone::upper_chest));
    const Look wanted = look_of(back * (partner - own.position(Bone::head)));
    share *= 1.0F - smootherstep(kSeen, kOutOfSight, std::abs(wanted.yaw));
    turn_head(share, own, wanted, pose);
}

}  // namespace

void look_at_one_another(const CoupleLook& look,
                         const WorldPose& lead_world,
                         const WorldPose& follow_world,
                         Pose& lead,
                         Pose& follow) noexcept RAKS_NONBLOCKING {
    if (look.share <= 0.0F) {
        return;
    }
    if (look.frame != nullptr) {
        const auto past = [&](std::size_t role) {
            return Look{static_cast<float>(look.frame->look[role]), kPastPitch};
        };
        turn_head(look.share, lead_world, past(0), lead);
        turn_head(look.share, follow_world, past(1), follow);
        return;
    }
    look_at(look.share, lead_world, follow_world.position(Bone::head), lead);
    look_at(look.share, follow_world, lead_world.position(Bone::head), follow);
}

}  // namespace raks::motion
