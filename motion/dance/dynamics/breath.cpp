#include "motion/dance/dynamics/breath.hpp"

#include <cmath>

#include "base/smooth_steps.hpp"

namespace raks::motion {
namespace {

constexpr float kChestOpens = 0.013F;     // radians of each of two bones
constexpr float kShouldersRise = 0.022F;  // radians
constexpr double kBreathPeriod = 3.3;     // seconds
constexpr float kBreathEases = 0.5F;      // seconds in which its depth changes
// Energy up to which a breath is whole, and from which on it is not seen.
constexpr float kCalmDance = 0.35F;
constexpr float kFullDance = 0.70F;
constexpr float kOfCalmDance = 0.8F;

/// In takes two fifths of a breath; -1 to 1.
float breath_at(StreamTime time) noexcept {
    const double phase = 2.0 * M_PI * to_seconds(time.time_since_epoch()) / kBreathPeriod;
    return static_cast<float>(std::sin(phase + 0.35 * std::sin(phase)));
}

}  // namespace

void Breath::advance(float energy, bool is_still) noexcept RAKS_NONBLOCKING {
    const float calm = kOfCalmDance * (1.0F - smoothstep(kCalmDance, kFullDance, energy));
    const float wanted = is_still ? 1.0F : calm;
    depth_ += static_cast<float>(to_seconds(kHop)) / kBreathEases * (wanted - depth_);
}

void Breath::apply(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING {
    const float breath = depth_ * breath_at(time);
    const float open = -0.5F * kChestOpens * breath;
    for (const Bone bone : {Bone::chest, Bone::upper_chest}) {
        pose.rotation(bone) =
            pose.rotation(bone) * glm::quat(std::cos(open), std::sin(open), 0.0F, 0.0F);
    }
    const float rise = 0.5F * kShouldersRise * breath;
    for (const Side side : kSides) {
        const float sign = side == Side::left ? 1.0F : -1.0F;
        const Bone shoulder = on_side(Bone::left_shoulder, side);
        pose.rotation(shoulder) =
            glm::quat(std::cos(rise), 0.0F, 0.0F, sign * std::sin(rise)) * pose.rotation(shoulder);
    }
}

}  // namespace raks::motion
