#include "motion/dance/hand_hold.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kTiny = 1e-6F;
// Distances between the hands, metres: up to the first they hold fully, beyond the second they have
// let go. (Released beyond 1.6 m or more they are dragged along: 10,400 m/s^3 and more.)
constexpr float kHeld = 0.3F;
constexpr float kReleased = 1.3F;
constexpr float kGrip = 0.06F;  // between both wrists, metres
// Distances of the meeting point from a shoulder, of the arm's length: nearer than the first they
// let go, beyond the second the shoulder does not matter. A point that passes close by a shoulder
// sweeps round it, and the arm with it.
constexpr float kAtShoulder = 0.2F;
constexpr float kClearOfShoulder = 0.8F;
constexpr double kSigma = 8.0;  // hops; deviation of the mean's weights over time
// Shortest distance of a hand from its shoulder, of the arm's length (elbow bent by 127 degrees),
// and that limit's softness.
constexpr float kNearest = 0.45F;
constexpr float kNearestSoftly = 0.2F;
// Longest distance (elbow bent by 37 degrees), and its softness.
constexpr float kFarthest = 0.95F;
constexpr float kFarthestSoftly = 0.15F;

float length_of(const WorldPose& world, const Limb& arm) noexcept {
    const glm::vec3 elbow = world.position(arm.lower);
    return glm::distance(arm.root, elbow) + glm::distance(elbow, world.position(arm.end));
}

/// The target of a hand, limited to the distances that its own arm reaches comfortably: nearer to
/// the shoulder the elbow would fly round, farther it would snap straight.
glm::vec3 within_reach(const WorldPose& world, const Limb& arm, const glm::vec3& target) noexcept {
    const float length = length_of(world, arm);
    const glm::vec3 line = target - arm.root;
    const float reach = glm::length(line);
    if (reach < kTiny) {
        return world.position(arm.end);
    }
    const float held = soft_max(reach, kNearest * length, kNearestSoftly * length);
    const float farthest = kFarthest * length;
    return arm.root - line * (soft_max(-held, -farthest, kFarthestSoftly * length) / reach);
}

// World poses of both, and the arms whose hands meet.
struct Couple {
    WorldPose lead;
    WorldPose follow;
    Limb left;   // the lead's arm
    Limb right;  // the follow's
};

Couple couple_of(const Skeleton& skeleton, const Pose& lead, const Pose& follow) noexcept {
    Couple couple;
    couple.lead = world_pose(skeleton, lead);
    couple.follow = world_pose(skeleton, follow);
    couple.left = arm_of(couple.lead, Side::left);
    couple.right = arm_of(couple.follow, Side::right);
    return couple;
}

}  // namespace

float wish_to_hold(const Skeleton& skeleton,
                   const Pose& lead,
                   const Pose& follow) noexcept RAKS_NONBLOCKING {
    const Couple couple = couple_of(skeleton, lead, follow);
    const glm::vec3 own = couple.lead.position(couple.left.end);
    const glm::vec3 other = couple.follow.position(couple.right.end);
    const glm::vec3 middle = 0.5F * (own + other);
    const auto clear_of = [&](const WorldPose& world, const Limb& arm) {
        const float reach = glm::distance(middle, arm.root) / length_of(world, arm);
        return smootherstep((reach - kAtShoulder) / (kClearOfShoulder - kAtShoulder));
    };
    return smootherstep((kReleased - glm::distance(own, other)) / (kReleased - kHeld)) *
           clear_of(couple.lead, couple.left) * clear_of(couple.follow, couple.right);
}

void join_hands(const Skeleton& skeleton,
                float hold,
                Pose& lead,
                Pose& follow) noexcept RAKS_NONBLOCKING {
    if (hold <= 0.0F) {
        return;
    }
    const Couple couple = couple_of(skeleton, lead, follow);
    const glm::vec3 own = couple.lead.position(couple.left.end);
    const glm::vec3 other = couple.follow.position(couple.right.end);
    const float apart = std::max(glm::distance(own, other), kTiny);
    const float left = std::max(0.0F, 1.0F - kGrip / apart);
    // Each hand goes half of what is missing beyond the grip.
    const glm::vec3 half_way = 0.5F * hold * left * (other - own);
    solve_limb(skeleton, couple.left, within_reach(couple.lead, couple.left, own + half_way), lead);
    solve_limb(skeleton,
               couple.right,
               within_reach(couple.follow, couple.right, other - half_way),
               follow);
}

// A truncated Gaussian, normalised over both sides.
HandHold::HandHold() noexcept {
    double sum = 0.0;
    for (int away = -kAround; away <= kAround; ++away) {
        sum += std::exp(-0.5 * away * away / (kSigma * kSigma));
    }
    for (std::size_t away = 0; away < weight_.size(); ++away) {
        const auto hops = static_cast<double>(away);
        weight_[away] = static_cast<float>(std::exp(-0.5 * hops * hops / (kSigma * kSigma)) / sum);
    }
}

void HandHold::reset() noexcept RAKS_NONBLOCKING {
    newest_ = -1;
    known_ = 0;
}

void HandHold::advance(const Skeleton& skeleton,
                       PoseTrack& lead,
                       PoseTrack& follow) noexcept RAKS_NONBLOCKING {
    const HopIndex now = lead.newest_final();
    // After a gap the remembered wishes belong to other moments.
    if (now != newest_ + 1) {
        known_ = 0;
    }
    std::array<float, 2 * kAround + 1> wishes{};  // from kAround hops ago on
    const auto at = [&](HopIndex hop) -> float& {
        return wishes[static_cast<std::size_t>(hop - now + kAround)];
    };
    const HopIndex first = now - known_;
    const HopIndex last = std::min(lead.newest(), follow.newest());
    for (HopIndex hop = first; hop < now; ++hop) {
        at(hop) = before_[static_cast<std::size_t>(hop) % before_.size()];
    }
    for (HopIndex hop = now; hop <= last; ++hop) {
        at(hop) = wish_to_hold(skeleton, lead.at_hop(hop), follow.at_hop(hop));
    }
    before_[static_cast<std::size_t>(now) % before_.size()] = at(now);
    newest_ = now;
    known_ = std::min(known_ + 1, kAround);
    for (HopIndex hop = now; hop <= last; ++hop) {
        float hold = 0.0F;
        for (HopIndex other = hop - kAround; other <= hop + kAround; ++other) {
            // Beyond the known range the nearest known wish is repeated.
            hold += weight_[static_cast<std::size_t>(std::abs(other - hop))] *
                    at(std::clamp(other, first, last));
        }
        Pose one = lead.at_hop(hop);
        Pose two = follow.at_hop(hop);
        join_hands(skeleton, hold, one, two);
        lead.replace(hop, one);
        follow.replace(hop, two);
    }
}

}  // namespace raks::motion
