#include "motion/dance/dynamics/planted_feet.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"
#include "base/time.hpp"
#include "motion/dance/body/floor_move.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr float kHopSeconds = 0.01F;
// A swinging foot makes up what it lags over its way: over this share of the lag, but over at least
// so many metres. Much less, and a short swing would throw the foot.
constexpr float kMadeUpShare = 0.8F;
constexpr float kMadeUpIn = 0.12F;
constexpr float kMostMadeUp = 0.030F;  // metres a hop; a later swing makes up the rest
constexpr float kDriftDecay = 18.0F;   // 1/s; of the speed that a foot had
constexpr float kTurnDecay = 3.0F;     // 1/s; a standing foot turns on its ball
constexpr float kTiltDecay = 9.0F;     // 1/s; of height, pitch and roll
// An own step: a foot this far away that has stood this long.
constexpr float kStepsBeyond = 0.05F;     // metres
constexpr float kStepsBeyondYaw = 0.35F;  // radians
constexpr int kStandsBefore = 35;         // hops
constexpr int kOwnStepHops = 30;          // of the step
constexpr float kOwnLift = 0.05F;         // metres, at its middle
constexpr float kNoLag = 1e-4F;           // metres, radians: less is none

glm::vec2 floor_place(const glm::vec3& place) noexcept { return {place.x, place.z}; }

glm::vec3 small_turn(glm::quat turn) noexcept {
    turn = turn.w < 0.0F ? -turn : turn;
    return 2.0F * glm::vec3(turn.x, turn.y, turn.z);
}

glm::quat turned_by(const glm::vec3& turn) noexcept {
    const float square = std::min(1.0F, 0.25F * glm::dot(turn, turn));
    return {std::sqrt(1.0F - square), 0.5F * turn.x, 0.5F * turn.y, 0.5F * turn.z};
}

float nearer_turn(float radians) noexcept {
    return std::remainder(radians, 2.0F * static_cast<float>(M_PI));
}

}  // namespace

void PlantedFeet::carry_over(const Skeleton& skeleton,
                             const Pose& shown,
                             const Pose& shown_before,
                             const Pose& next,
                             const Pose& next_before) noexcept RAKS_NONBLOCKING {
    const WorldPose now = world_body(skeleton, shown);
    const WorldPose before = world_body(skeleton, shown_before);
    const WorldPose wanted = world_body(skeleton, next);
    const WorldPose wanted_before = world_body(skeleton, next_before);
    for (const Side side : kSides) {
        const FootPlace is = foot_place(skeleton, now, side);
        const FootPlace was = foot_place(skeleton, before, side);
        const FootPlace shall = foot_place(skeleton, wanted, side);
        const FootPlace should = foot_place(skeleton, wanted_before, side);
        Foot foot;
        foot.away = floor_place(is.pivot - shall.pivot);
        foot.drift = (floor_place(is.pivot - was.pivot) - floor_place(shall.pivot - should.pivot)) /
                     kHopSeconds;
        foot.yaw = nearer_turn(foot_heading(is.rotation) - foot_heading(shall.rotation));
        foot.height = is.pivot.y - shall.pivot.y;
        foot.tilt =
            small_turn(is.rotation * glm::conjugate(turn_about_up(foot.yaw) * shall.rotation));
        foot.place = floor_place(shall.pivot);
        foot.is_known = true;
        feet_[static_cast<std::size_t>(side)] = foot;
    }
}

// One hop of one foot. `place`: where the motion wants it, and whether it stands there.
void PlantedFeet::advance(Foot& foot,
                          const Foot& other,
                          const glm::vec2& place,
                          bool stands,
                          OwnSteps steps) const noexcept {
    const float way = foot.is_known ? glm::distance(place, foot.place) : 0.0F;
    foot.place = place;
    foot.is_known = true;
    foot.stood = stands ? foot.stood + 1 : 0;
    if (stands) {
        foot.yaw *= std::exp(-kTurnDecay * kHopSeconds);
    } else {
        const float over = std::max(kMadeUpIn, kMadeUpShare * glm::length(foot.away));
        const float most = kMostMadeUp / std::max(glm::length(foot.away), kMostMadeUp);
        const float left = std::max(std::exp(-way / over), 1.0F - most);
        foot.away *= left;
        foot.yaw *= left;
    }
    foot.away += foot.drift * kHopSeconds;
    foot.drift *= std::exp(-kDriftDecay * kHopSeconds);
    const float tilt_left = std::exp(-kTiltDecay * kHopSeconds);
    foot.height *= tilt_left;
    foot.tilt *= tilt_left;
    const bool is_far =
        glm::length(foot.away) > kStepsBeyond || std::abs(foot.yaw) > kStepsBeyondYaw;
    if (steps == OwnSteps::may_begin && foot.stepped == 0 && is_far && foot.stood > kStandsBefore &&
        other.stepped == 0 && other.stood > 0) {
        foot.from = foot.away;
        foot.from_yaw = foot.yaw;
        foot.stepped = 1;
    } else if (foot.stepped > 0) {
        const auto share = [](int hops) {
            return smootherstep(static_cast<float>(hops) / static_cast<float>(kOwnStepHops));
        };
        const float gone = share(foot.stepped) - share(foot.stepped - 1);
        foot.away -= gone * foot.from;
        foot.yaw -= gone * foot.from_yaw;
        foot.stepped = foot.stepped >= kOwnStepHops ? 0 : foot.stepped + 1;
    }
}

bool PlantedFeet::has_lag() const noexcept {
    return std::any_of(feet_.begin(), feet_.end(), [](const Foot& foot) {
        return foot.stepped > 0 || glm::length(foot.away) > kNoLag || std::abs(foot.yaw) > kNoLag ||
               std::abs(foot.height) > kNoLag || glm::length(foot.tilt) > kNoLag;
    });
}

Pose PlantedFeet::apply(const Skeleton& skeleton,
                        const Pose& wanted,
                        OwnSteps steps) noexcept RAKS_NONBLOCKING {
    const WorldPose world = world_body(skeleton, wanted);
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        advance(feet_[s],
                feet_[1 - s],
                floor_place(foot_place(skeleton, world, side).pivot),
                wanted.foot_contact[s],
                steps);
    }
    return with_lag(skeleton, wanted);
}

Pose PlantedFeet::with_lag(const Skeleton& skeleton,
                           const Pose& wanted) const noexcept RAKS_NONBLOCKING {
    if (!has_lag()) {
        return wanted;
    }
    const WorldPose world = world_body(skeleton, wanted);
    Pose pose = wanted;
    std::array<FootTarget, 2> targets;
    std::array<glm::vec3, 2> ankles{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const Foot& foot = feet_[s];
        const FootPlace place = foot_place(skeleton, world, side);
        FootTarget& target = targets[s];
        target.rotation = turned_by(foot.tilt) * turn_about_up(foot.yaw) * place.rotation;
        glm::vec3 pivot = place.pivot + glm::vec3(foot.away.x, foot.height, foot.away.y);
        if (foot.stepped > 0) {
            const float share =
                smootherstep(static_cast<float>(foot.stepped) / static_cast<float>(kOwnStepHops));
            pivot.y += kOwnLift * 4.0F * share * (1.0F - share);
            pose.foot_contact[s] = false;
        }
        target.ankle = pivot - pivot_from_ankle(skeleton, side, target.rotation);
        const float standing = -lowest_of_sole(
            skeleton, side, target.rotation, pose.rotation(on_side(Bone::left_toes, side)));
        target.ankle.y = std::max(target.ankle.y, standing);
        ankles[s] = target.ankle;
    }
    const glm::vec2 hips = 0.5F * (feet_[0].away + feet_[1].away);
    pose.hips_position += glm::vec3(hips.x, 0.0F, hips.y);
    lower_to_reach(skeleton, ankles, pose);
    for (const Side side : kSides) {
        solve_leg(skeleton, side, targets[static_cast<std::size_t>(side)], pose);
    }
    return pose;
}

}  // namespace raks::motion
