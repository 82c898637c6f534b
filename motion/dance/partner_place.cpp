#include "motion/dance/partner_place.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "base/time.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kPlaceHop = static_cast<float>(to_seconds(kHop));
// Radians a second of the critically damped spring that moves her: half the way in 0.15 s.
constexpr float kSpring = 11.0F;
constexpr float kFootSeconds = 0.07F;  // time constant of a foot in the air
constexpr float kFootLeaves = 0.15F;   // seconds in the air until it goes as fast
constexpr float kMostAside = 0.17F;    // metres that the hips may be aside of the feet, soft limit
constexpr float kNowhere = 1e-5F;      // metres; less is not moved

glm::vec2 floor_of(const glm::vec3& point) noexcept { return {point.x, point.z}; }

glm::vec2 facing_of(const Pose& pose) noexcept {
    return floor_of(pose.rotation(Bone::hips) * glm::vec3(0.0F, 0.0F, 1.0F));
}

glm::vec2 limited(const glm::vec2& way) noexcept {
    const float length = glm::length(way);
    return length < kNowhere ? way : way * (kMostAside * std::tanh(length / kMostAside) / length);
}

}  // namespace

glm::vec2 missing_way(const ClosedFrame* frame,
                      const CoupleSizes& sizes,
                      const Pose& lead,
                      const Pose& follow) noexcept RAKS_NONBLOCKING {
    const glm::vec2 own = floor_of(lead.hips_position);
    const glm::vec2 other = floor_of(follow.hips_position);
    if (frame != nullptr && frame->hips) {
        // Of both, so that a turn of one hip swings her half as far.
        const glm::vec2 both = facing_of(lead) - facing_of(follow);
        const float length = glm::length(both);
        if (length < kNowhere) {
            return {};
        }
        const glm::vec2 ahead = both / length;
        const glm::vec2 left(ahead.y, -ahead.x);
        const glm::vec2 place(*frame->hips);
        return own + sizes.mean() * (place.x * left + place.y * ahead) - other;
    }
    return own + sizes.mean() * (other / sizes.follow - own / sizes.lead) - other;
}

void PartnerPlace::advance(const glm::vec2& way, const Pose& danced) noexcept RAKS_NONBLOCKING {
    speed_ += kPlaceHop * kSpring * (kSpring * (way - goal_) - 2.0F * speed_);
    goal_ += kPlaceHop * speed_;
    for (std::size_t side = 0; side < feet_.size(); ++side) {
        air_[side] = danced.foot_contact[side] ? 0.0F : air_[side] + kPlaceHop;
        // The hips lean after the feet: a foot that leaves at once would jerk them.
        const float leaves = smoothstep(0.0F, kFootLeaves, air_[side]);
        feet_[side] += leaves * kPlaceHop / kFootSeconds * (goal_ - feet_[side]);
    }
}

void PartnerPlace::apply(const Skeleton& skeleton, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const glm::vec2 feet = 0.5F * (feet_[0] + feet_[1]);
    const glm::vec2 hips = feet + limited(goal_ - feet);
    if (std::max({glm::length(hips), glm::length(feet_[0]), glm::length(feet_[1])}) < kNowhere) {
        return;
    }
    const WorldPose world = world_body(skeleton, pose);
    pose.hips_position += glm::vec3(hips.x, 0.0F, hips.y);
    std::array<FootTarget, 2> targets;
    std::array<glm::vec3, 2> ankles{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const Bone foot = on_side(Bone::left_foot, side);
        ankles[s] = world.position(foot) + glm::vec3(feet_[s].x, 0.0F, feet_[s].y);
        targets[s] = {ankles[s], world.rotation(foot)};
    }
    lower_to_reach(skeleton, ankles, pose);
    for (const Side side : kSides) {
        solve_leg(skeleton, side, targets[static_cast<std::size_t>(side)], pose);
    }
}

}  // namespace raks::motion
