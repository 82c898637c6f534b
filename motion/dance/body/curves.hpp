// Curves: a rounded maximum, and closed curves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace raks::motion {

/// The larger of both, rounded where they are nearer than `softness`; twice differentiable.
/// Threads: any. Real-time: yes.
[[nodiscard]] inline float soft_max(float a, float b, float softness) {
    const float apart = std::clamp(std::abs(a - b) / std::max(softness, 1e-9F), 0.0F, 1.0F);
    const float near = 1.0F - apart;
    return std::max(a, b) + softness * near * near * near / 6.0F;
}

// Closed curves: values sampled over one figure that repeats for ever.

/// Index i modulo `size`, also for negative i.
[[nodiscard]] inline std::size_t wrap(std::ptrdiff_t i, std::size_t size) noexcept {
    const auto n = static_cast<std::ptrdiff_t>(size);
    return static_cast<std::size_t>(((i % n) + n) % n);
}

/// The values convolved with a Gaussian, over the ends; sigma in samples, > 0. Real-time: no.
template <typename T>
[[nodiscard]] std::vector<T> smoothed(const std::vector<T>& values, double sigma) {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma));
    std::vector<double> weights;
    double total = 0.0;
    for (std::ptrdiff_t step = -reach; step <= reach; ++step) {
        const double d = static_cast<double>(step) / sigma;
        weights.push_back(std::exp(-0.5 * d * d));
        total += weights.back();
    }
    std::vector<T> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        double sum = 0.0;
        std::size_t at = wrap(static_cast<std::ptrdiff_t>(i) - reach, values.size());
        for (const double weight : weights) {
            sum += weight * static_cast<double>(values[at]);
            at = at + 1 == values.size() ? 0 : at + 1;
        }
        result[i] = static_cast<T>(sum / total);
    }
    return result;
}

}  // namespace raks::motion
