#include "motion/dance/dynamics/looks.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/dance/body/floor_move.hpp"

namespace raks::motion {
namespace {

constexpr double kLookSeconds = 2.2;   // one look
constexpr double kTurnShare = 0.35;    // of it, in which the head turns to the next
constexpr float kSurelySeen = 1.1F;    // radians aside of the trunk's heading that a head turns to
constexpr float kNeverSeen = 2.2F;     // beyond it nothing is looked at
constexpr float kFarthestTurn = 0.9F;  // radians that neck and head turn at most
constexpr float kWaitsAside = 0.75F;   // radians to the sides, of who looks around

constexpr std::uint64_t kAimStream = 11;  // streams of random numbers
constexpr std::uint64_t kAttentionStream = 12;

/// One aim: heading in the world, and how far the head goes there.
struct Aim {
    float heading = 0.0F;
    float weight = 0.0F;
};

Aim aim_of(std::uint64_t cell, std::uint64_t seed, LookFor what) noexcept {
    const double where = CounterRandom(seed, kAimStream).uniform(cell);
    const double attention = CounterRandom(seed, kAttentionStream).uniform(cell);
    switch (what) {
        case LookFor::dance:
            return {0.0F, attention < 0.35 ? 0.0F : static_cast<float>(0.75 * attention)};
        case LookFor::pose:
            return {0.0F, 0.85F};
        case LookFor::wait:
            // Every second look is to the front.
            return {attention < 0.5 ? 0.0F : kWaitsAside * static_cast<float>(2.0 * where - 1.0),
                    0.8F};
    }
    return {};
}

float heading_of_bone(const WorldPose& world, Bone bone) noexcept {
    const glm::vec3 ahead = world.rotation(bone) * glm::vec3(0.0F, 0.0F, 1.0F);
    return std::atan2(ahead.x, ahead.z);
}

float wrapped(float radians) noexcept {
    return std::remainder(radians, 2.0F * static_cast<float>(M_PI));
}

Aim between(const Aim& from, const Aim& to, float share) noexcept {
    return {from.heading + share * wrapped(to.heading - from.heading),
            from.weight + share * (to.weight - from.weight)};
}

}  // namespace

void look(const Skeleton& skeleton,
          StreamTime time,
          std::uint64_t seed,
          const LookChange& change,
          Pose& pose) noexcept RAKS_NONBLOCKING {
    const double cells = std::max(0.0, to_seconds(time.time_since_epoch()) / kLookSeconds);
    const auto cell = static_cast<std::uint64_t>(cells);
    const auto share = static_cast<float>((cells - static_cast<double>(cell)) / kTurnShare);
    const Aim next = between(
        aim_of(cell, seed, change.now), aim_of(cell + 1, seed, change.now), smootherstep(share));
    const Aim last = between(aim_of(cell, seed, change.before),
                             aim_of(cell + 1, seed, change.before),
                             smootherstep(share));
    const Aim aim = between(last, next, change.share);

    const WorldPose world = world_pose(skeleton, pose);
    const float aside = wrapped(aim.heading - heading_of_bone(world, Bone::upper_chest));
    const float seen = 1.0F - smoothstep(kSurelySeen, kNeverSeen, std::abs(aside));
    const float missing = wrapped(aim.heading - heading_of_bone(world, Bone::head));
    const float turn = aim.weight * seen * std::clamp(missing, -kFarthestTurn, kFarthestTurn);
    // Half by the neck, half by the head, about the upright axis of the world.
    for (const Bone bone : {Bone::neck, Bone::head}) {
        const glm::quat parent =
            bone == Bone::neck ? world.rotation(Bone::upper_chest) : world.rotation(Bone::neck);
        const glm::quat own = glm::conjugate(parent) * turn_about_up(0.5F * turn) * parent;
        pose.rotation(bone) = glm::normalize(own * pose.rotation(bone));
    }
}

}  // namespace raks::motion
