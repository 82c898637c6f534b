#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

/// Closed curves: values sampled over one figure that repeats for ever.
namespace raks::motion {

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
