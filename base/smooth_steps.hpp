#pragma once

#include <algorithm>

/// Ways from 0 to 1 without a kink. Threads: any. Real-time: yes.
namespace raks {

/// 0 below `from`, 1 above `to`, with flat ends: 3 t^2 - 2 t^3.
[[nodiscard]] constexpr float smoothstep(float from, float to, float x) noexcept {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// From 0 at t = 0 to 1 at t = 1 (clamped) with no speed and acceleration at either end:
/// 6 t^5 - 15 t^4 + 10 t^3.
[[nodiscard]] constexpr float smootherstep(float t) noexcept {
    t = std::clamp(t, 0.0F, 1.0F);
    return t * t * t * (10.0F + t * (-15.0F + t * 6.0F));
}

/// The same from 0 below `from` to 1 above `to`.
[[nodiscard]] constexpr float smootherstep(float from, float to, float x) noexcept {
    return smootherstep((x - from) / (to - from));
}

}  // namespace raks
