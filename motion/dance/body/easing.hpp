// Easing functions.
#pragma once

#include <algorithm>
#include <cmath>

namespace raks::motion {

/// From 0 at t = 0 to 1 at t = 1 (clamped) with no speed and acceleration at either end.
/// Threads: any. Real-time: yes.
[[nodiscard]] inline float smootherstep(float t) noexcept {
    t = std::clamp(t, 0.0F, 1.0F);
    return t * t * t * (10.0F + t * (-15.0F + t * 6.0F));
}

/// The larger of both, rounded where they are nearer than `softness`; twice differentiable.
/// Threads: any. Real-time: yes.
[[nodiscard]] inline float soft_max(float a, float b, float softness) {
    const float apart = std::clamp(std::abs(a - b) / std::max(softness, 1e-9F), 0.0F, 1.0F);
    const float near = 1.0F - apart;
    return std::max(a, b) + softness * near * near * near / 6.0F;
}

}  // namespace raks::motion
