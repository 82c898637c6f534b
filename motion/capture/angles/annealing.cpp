#include "motion/capture/angles/annealing.hpp"

#include <algorithm>
#include <cmath>

#include "base/simd_clones.hpp"
#include "models/fast_exp.hpp"

namespace raks::capture {
namespace {

constexpr float kLeastExponent = -80.0F;  // what fast_exp takes
constexpr float kLeastBeta = 1e-4F;
constexpr float kMostBeta = 1e5F;
constexpr int kMostHalvings = 40;
constexpr double kNearEnough = 0.01;  // of the survival, relative

RAKS_SIMD_CLONES void weigh_all(
    const float* costs, std::size_t count, float least, float beta, float* __restrict weights) {
    // Bounded in a loop of its own, so that both are vectorized.
    for (std::size_t i = 0; i < count; ++i) {
        weights[i] = std::max(kLeastExponent, -beta * (costs[i] - least));
    }
    for (std::size_t i = 0; i < count; ++i) {
        weights[i] = models::fast_exp(weights[i]);
    }
}

}  // namespace

void weights_of(std::span<const float> costs, float beta, std::span<float> weights) {
    const float least = *std::min_element(costs.begin(), costs.end());
    weigh_all(costs.data(), costs.size(), least, beta, weights.data());
}

double survival_of(std::span<const float> weights) {
    double sum = 0.0;
    double squares = 0.0;
    for (const float weight : weights) {
        const auto w = static_cast<double>(weight);
        sum += w;
        squares += w * w;
    }
    return sum * sum / (static_cast<double>(weights.size()) * squares);
}

float anneal(std::span<const float> costs, double survival, std::span<float> weights) {
    // The survival falls as beta grows; bisection in its logarithm.
    float low = kLeastBeta;
    float high = kMostBeta;
    float beta = 1.0F;
    for (int i = 0; i < kMostHalvings; ++i) {
        weights_of(costs, beta, weights);
        const double now = survival_of(weights);
        if (std::abs(now - survival) < kNearEnough * survival) {
            break;
        }
        (now > survival ? low : high) = beta;
        beta = std::sqrt(low * high);
    }
    return beta;
}

void resample(std::span<const float> weights, double start, std::vector<std::size_t>& chosen) {
    double sum = 0.0;
    for (const float weight : weights) {
        sum += static_cast<double>(weight);
    }
    const double step = sum / static_cast<double>(weights.size());
    chosen.resize(weights.size());
    std::size_t from = 0;
    double reached = static_cast<double>(weights[0]);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const double tooth = (static_cast<double>(i) + start) * step;
        while (reached <= tooth && from + 1 < weights.size()) {
            ++from;
            reached += static_cast<double>(weights[from]);
        }
        chosen[i] = from;
    }
}

}  // namespace raks::capture
