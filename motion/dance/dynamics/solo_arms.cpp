#include "motion/dance/dynamics/solo_arms.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr std::uint64_t kSoloStream = 77;
constexpr std::uint64_t kWayStream = 78;
constexpr float kUnlike = 0.18F;       // share of the way from home that it differs by
constexpr double kLongestWay = 1.0;    // beats that a hand takes to its next key
constexpr float kStraightest = 0.99F;  // of the arm's length
constexpr float kMostFolded = 0.25F;
constexpr float kTinyLine = 1e-4F;

/// Which pattern is danced, and whether left for right.
struct Chosen {
    std::size_t pattern = 0;
    bool is_mirrored = false;
};

Chosen chosen_at(const SoloArms& solo, std::uint64_t seed, std::int64_t number) noexcept {
    const CounterRandom random(seed, kSoloStream);
    const auto count = static_cast<std::uint64_t>(solo.patterns.size());
    const auto at = static_cast<std::uint64_t>(std::max<std::int64_t>(number, 0));
    if (count < 3) {
        return {static_cast<std::size_t>(at % count), (at / count) % 2 == 1};
    }
    // Even ones are drawn from all, odd ones from those that are neither before nor after.
    const auto even = [&](std::uint64_t n) { return random.below(2 * n, count); };
    const bool is_mirrored = random.below(2 * at + 1, 2) == 1;
    if (at % 2 == 0) {
        return {static_cast<std::size_t>(even(at)), is_mirrored};
    }
    std::uint64_t pattern = even(at);
    while (pattern == even(at - 1) || pattern == even(at + 1)) {
        pattern = (pattern + 1) % count;  // of three at least one is neither
    }
    return {static_cast<std::size_t>(pattern), is_mirrored};
}

/// Where a hand is: it leaves its key as late as it may.
glm::vec3 wrist_at(const std::vector<ArmPattern::Key>& keys,
                   const glm::vec3& home,
                   double beats,
                   double beat) noexcept {
    glm::vec3 from = home;
    double since = 0.0;
    for (const ArmPattern::Key& key : keys) {
        if (beat < key.beat) {
            const double leaves = std::max(since, key.beat - kLongestWay);
            return glm::mix(from,
                            key.wrist,
                            smootherstep(static_cast<float>(leaves),
                                         static_cast<float>(key.beat),
                                         static_cast<float>(beat)));
        }
        from = key.wrist;
        since = key.beat;
    }
    const double leaves = std::max(since, beats - kLongestWay);
    return glm::mix(
        from,
        home,
        smootherstep(
            static_cast<float>(leaves), static_cast<float>(beats), static_cast<float>(beat)));
}

/// How far this time's way from home is from what is written, outward, up and ahead: no two times
/// are alike.
glm::vec3 ways_at(std::uint64_t seed, std::int64_t number, Side side) noexcept {
    const CounterRandom random(seed, kWayStream);
    const auto first = 6 * static_cast<std::uint64_t>(std::max<std::int64_t>(number, 0)) +
                       3 * static_cast<std::uint64_t>(side);
    glm::vec3 ways{};
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
        ways[static_cast<glm::vec3::length_type>(axis)] =
            1.0F + kUnlike * (2.0F * static_cast<float>(random.uniform(first + axis)) - 1.0F);
    }
    return ways;
}

glm::vec3 left_or_right(const glm::vec3& left, Side side) noexcept {
    return {side == Side::left ? left.x : -left.x, left.y, left.z};
}

/// Turns an arm to a wrist, the elbow towards `aim`, its hinge square to both bones as elbows bend.
void put_arm(const Skeleton& skeleton,
             const WorldPose& world,
             Side side,
             const glm::vec3& wrist,
             const glm::vec3& aim,
             Pose& pose) noexcept {
    const Limb arm = arm_of(world, side);
    const float upper = glm::length(skeleton.offsets[index_of(arm.lower)]);
    const float lower = glm::length(skeleton.offsets[index_of(arm.end)]);
    const float wanted = glm::length(wrist);
    const glm::vec3 line = wanted > kTinyLine ? wrist / wanted : glm::vec3(0.0F, -1.0F, 0.0F);
    const float distance =
        std::clamp(wanted,
                   std::max(kMostFolded * (upper + lower), std::abs(upper - lower) + kTinyLine),
                   kStraightest * (upper + lower));
    const float along = (upper * upper - lower * lower + distance * distance) / (2.0F * distance);
    const float aside = std::sqrt(std::max(0.0F, upper * upper - along * along));
    const glm::vec3 pole = aim - line * glm::dot(line, aim);
    const glm::vec3 elbow = line * along + pole * (aside / std::max(glm::length(pole), kTinyLine));
    const glm::vec3 forearm = line * distance - elbow;
    const float sign = side == Side::left ? 1.0F : -1.0F;
    const glm::vec3 across = glm::cross(elbow, forearm);
    const glm::vec3 hinge = across * (-sign / std::max(glm::length(across), kTinyLine * kTinyLine));
    const auto turned = [&](const glm::vec3& bone) {
        const glm::vec3 out = sign * glm::normalize(bone);
        return glm::quat_cast(glm::mat3(out, hinge, glm::cross(out, hinge)));
    };
    const glm::quat upper_world = turned(elbow);
    const glm::quat lower_world = turned(forearm);
    pose.rotation(arm.upper) = glm::normalize(glm::conjugate(arm.parent) * upper_world);
    pose.rotation(arm.lower) = glm::normalize(glm::conjugate(upper_world) * lower_world);
    pose.rotation(arm.end) = kNoRotation;
}

}  // namespace

void dance_solo_arms(const SoloArms& solo,
                     const SoloMoment& moment,
                     const Skeleton& skeleton,
                     Pose& pose) noexcept RAKS_NONBLOCKING {
    if (solo.patterns.empty()) {
        return;
    }
    const double number = std::floor(moment.phase / solo.beats);
    const double beat = moment.phase - number * solo.beats;
    const Chosen chosen = chosen_at(solo, moment.seed, static_cast<std::int64_t>(number));
    const ArmPattern& pattern = solo.patterns[chosen.pattern];
    // All patterns begin and end alike, their elbows too.
    const float own_elbow =
        smootherstep(static_cast<float>(std::min(beat, solo.beats - beat) / kLongestWay));
    const WorldPose world = world_body(skeleton, pose);
    const glm::quat& chest = world.rotation(Bone::upper_chest);
    for (const Side side : kSides) {
        const auto own = static_cast<std::size_t>(side);
        const std::size_t hand = chosen.is_mirrored ? 1 - own : own;
        const Limb arm = arm_of(world, side);
        const float length = glm::length(skeleton.offsets[index_of(arm.lower)]) +
                             glm::length(skeleton.offsets[index_of(arm.end)]);
        const glm::vec3 written = wrist_at(pattern.keys[hand], solo.home, solo.beats, beat);
        const glm::vec3 ways =
            moment.size * ways_at(moment.seed, static_cast<std::int64_t>(number), side);
        const glm::vec3 wrist = solo.home + ways * (written - solo.home);
        put_arm(skeleton,
                world,
                side,
                chest * (length * left_or_right(wrist, side)),
                chest * left_or_right(glm::mix(kUsualElbow, pattern.elbow[hand], own_elbow), side),
                pose);
    }
}

}  // namespace raks::motion
