#pragma once

#include <algorithm>

#include "models/fast_exp.hpp"

namespace raks::models {

/// Logistic function 1 / (1 + e^-x), x clamped to +-30: the same bits on every machine. Real-time:
/// yes.
[[nodiscard]] inline float logistic(float x) noexcept {
    return 1.0F / (1.0F + fast_exp(-std::clamp(x, -30.0F, 30.0F)));
}

/// tanh(x) by the logistic function, with the same properties. Real-time: yes.
[[nodiscard]] inline float fast_tanh(float x) noexcept { return 2.0F * logistic(2.0F * x) - 1.0F; }

}  // namespace raks::models
