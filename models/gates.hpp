#pragma once

#include "models/fast_exp.hpp"

namespace raks::models {

/// x clamped to +-30, beyond which the logistic function is 0 or 1. NaN stays. Real-time: yes.
[[nodiscard]] inline float gate_range(float x) noexcept {
    constexpr float kFarthest = 30.0F;
    const float above = x < -kFarthest ? -kFarthest : x;
    return kFarthest < above ? kFarthest : above;
}

/// Logistic function 1 / (1 + e^-x) of a gate_range(): for loops, which the compiler vectorizes
/// where the clamping is a loop of its own. Real-time: yes.
[[nodiscard]] inline float logistic_in_range(float x) noexcept {
    return 1.0F / (1.0F + fast_exp(-x));
}

/// Logistic function 1 / (1 + e^-x), x clamped to +-30: the same bits on every machine. Real-time:
/// yes.
[[nodiscard]] inline float logistic(float x) noexcept { return logistic_in_range(gate_range(x)); }

/// tanh(x) by the logistic function, with the same properties. Real-time: yes.
[[nodiscard]] inline float fast_tanh(float x) noexcept { return 2.0F * logistic(2.0F * x) - 1.0F; }

}  // namespace raks::models
