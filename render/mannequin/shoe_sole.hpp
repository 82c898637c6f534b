#pragma once

#include "render/mannequin/steps.hpp"

namespace raks::render {

/// The underside of the dance shoe: flat at heel and ball, arched between. All in the T-pose,
/// metres; `z` from the ankle's column to the toes (heel -0.075, toe tip 0.178).
inline constexpr float kArch = 0.015F;
inline constexpr float kHeelBreast = -0.020F;  // front face of the heel

/// Height of the underside over the floor.
[[nodiscard]] constexpr float sole_height(float z) noexcept {
    return kArch * smoothstep(kHeelBreast - 0.006F, kHeelBreast + 0.008F, z) *
           (1.0F - smoothstep(0.020F, 0.085F, z));
}

/// Height up to which the shoe is sole or heel: a heel of 16 mm, a thin sole in front.
[[nodiscard]] constexpr float sole_top(float z) noexcept {
    constexpr float kHeel = 0.018F;
    constexpr float kSole = 0.006F;
    const float in_front = smoothstep(kHeelBreast - 0.006F, kHeelBreast + 0.010F, z);
    return kHeel + (sole_height(z) + kSole - kHeel) * in_front;
}

}  // namespace raks::render
