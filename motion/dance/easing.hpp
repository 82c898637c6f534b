#pragma once

#include <algorithm>

namespace raks::motion {

/// From 0 at t = 0 to 1 at t = 1 (clamped) with no speed and acceleration at either end.
/// Threads: any. Real-time: yes.
[[nodiscard]] inline float smootherstep(float t) noexcept {
    t = std::clamp(t, 0.0F, 1.0F);
    return t * t * t * (10.0F + t * (-15.0F + t * 6.0F));
}

}  // namespace raks::motion
