#include "motion/dance/dynamics/waiting.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "base/smooth_steps.hpp"
#include "motion/dance/body/limb_ik.hpp"

namespace raks::motion {
namespace {

constexpr double kShiftSeconds = 3.6;  // of one stance, on one leg or the other
constexpr float kShift = 0.045F;       // metres to the standing leg
constexpr float kShiftRoll = 0.05F;    // radians of the hips
constexpr double kShakeEvery = 11.0;   // seconds; hands are shaken once in each
constexpr double kShakeSeconds = 1.1;
constexpr double kShakeRate = 4.0;  // a second
constexpr float kShake = 0.28F;     // radians of the wrists
constexpr float kNod = 0.13F;       // radians of neck and head
constexpr float kGive = 0.014F;     // metres that the knees give
constexpr float kBow = 0.26F;       // radians of hips, and of each bone of the spine the half

constexpr std::uint64_t kShiftStream = 21;  // streams of random numbers
constexpr std::uint64_t kShakeStream = 22;

glm::quat about_x(float radians) noexcept {
    return {std::cos(0.5F * radians), std::sin(0.5F * radians), 0.0F, 0.0F};
}
glm::quat about_z(float radians) noexcept {
    return {std::cos(0.5F * radians), 0.0F, 0.0F, std::sin(0.5F * radians)};
}

/// -1 to 1: on the right leg, on the left one.
float weight_at(StreamTime time, std::uint64_t seed) noexcept {
    constexpr float kChange = 0.4F;  // share of a stance in which the weight goes over
    const double cells = std::max(0.0, to_seconds(time.time_since_epoch()) / kShiftSeconds);
    const auto cell = static_cast<std::uint64_t>(cells);
    const auto side = [&](std::uint64_t i) {
        const auto far =
            static_cast<float>(0.4 + 0.6 * CounterRandom(seed, kShiftStream).uniform(i));
        return i % 2 == 0 ? far : -far;
    };
    const auto share = static_cast<float>(cells - static_cast<double>(cell)) / kChange;
    return side(cell) + smootherstep(share) * (side(cell + 1) - side(cell));
}

/// Turn of the wrists while the hands are shaken out; radians.
float shake_at(StreamTime time, std::uint64_t seed) noexcept {
    const double cells = std::max(0.0, to_seconds(time.time_since_epoch()) / kShakeEvery);
    const auto cell = static_cast<std::uint64_t>(cells);
    const double latest = kShakeEvery - kShakeSeconds;
    const double begins = latest * CounterRandom(seed, kShakeStream).uniform(cell);
    const double into = kShakeEvery * (cells - static_cast<double>(cell)) - begins;
    if (into <= 0.0 || into >= kShakeSeconds) {
        return 0.0F;
    }
    const double grows = std::sin(M_PI * into / kShakeSeconds);
    return kShake * static_cast<float>(grows * grows * std::sin(2.0 * M_PI * kShakeRate * into));
}

/// [0, 1]: how far one is bent in a bow.
float bow_at(double seconds) noexcept {
    const auto t = static_cast<float>(seconds);
    return smootherstep(0.0F, 0.8F, t) *
           (1.0F - smootherstep(1.1F, static_cast<float>(kBowSeconds), t));
}

}  // namespace

void wait(const Skeleton& skeleton,
          const WaitingMoment& moment,
          Pose& pose) noexcept RAKS_NONBLOCKING {
    const Pose stands = pose;
    const float weight = weight_at(moment.time, moment.seed);
    const glm::quat hips = pose.rotation(Bone::hips);
    pose.hips_position +=
        hips * glm::vec3(kShift * weight, -0.15F * kShift * weight * weight, 0.0F);
    pose.rotation(Bone::hips) = hips * about_z(-kShiftRoll * weight);
    pose.rotation(Bone::spine) = about_z(0.7F * kShiftRoll * weight) * pose.rotation(Bone::spine);

    // Down on the beat, up between two.
    const auto down = static_cast<float>(0.5 + 0.5 * std::cos(2.0 * M_PI * moment.beat));
    pose.hips_position.y -= kGive * moment.felt * down;
    for (const Bone bone : {Bone::neck, Bone::head}) {
        pose.rotation(bone) = pose.rotation(bone) * about_x(0.5F * kNod * moment.felt * down);
    }

    const float shake = shake_at(moment.time, moment.seed);
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        const Bone hand = on_side(Bone::left_hand, side);
        pose.rotation(hand) = pose.rotation(hand) * about_z(sign * shake);
    }

    if (moment.bowing > 0.0 && moment.bowing < kBowSeconds) {
        const float bow = kBow * bow_at(moment.bowing);
        pose.rotation(Bone::hips) = pose.rotation(Bone::hips) * about_x(bow);
        pose.hips_position += hips * glm::vec3(0.0F, -0.03F, -0.25F) * bow;
        for (const Bone bone : {Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck}) {
            pose.rotation(bone) = pose.rotation(bone) * about_x(0.6F * bow);
        }
    }
    put_feet_as(skeleton, stands, pose);
}

}  // namespace raks::motion
