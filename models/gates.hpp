#pragma once

#include <algorithm>

#include "models/fast_exp.hpp"

namespace raks::models {

/// 1 / (1 + e^-x): the same bits on every machine.
[[nodiscard]] inline float logistic(float x) noexcept {
    return 1.0F / (1.0F + fast_exp(-std::clamp(x, -30.0F, 30.0F)));
}

[[nodiscard]] inline float fast_tanh(float x) noexcept { return 2.0F * logistic(2.0F * x) - 1.0F; }

}  // namespace raks::models
