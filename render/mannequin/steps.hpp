#pragma once

#include <algorithm>

namespace raks::render {

/// 0 below `from`, 1 above `to`, with flat ends: 3 t^2 - 2 t^3.
[[nodiscard]] constexpr float smoothstep(float from, float to, float x) noexcept {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// The same with zero curvature at the ends: 6 t^5 - 15 t^4 + 10 t^3.
[[nodiscard]] constexpr float smootherstep(float from, float to, float x) noexcept {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

}  // namespace raks::render
