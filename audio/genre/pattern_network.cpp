#include "audio/genre/pattern_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/assert.hpp"

namespace raks::audio {

void normalize_logs(std::span<float> logs) noexcept RAKS_NONBLOCKING {
    // The greatest value is taken out before exp, so that nothing overflows.
    const float best = *std::max_element(logs.begin(), logs.end());
    float sum = 0.0F;
    for (const float log : logs) {
        sum += std::exp(log - best);
    }
    const float all = best + std::log(sum);
    for (float& log : logs) {
        log -= all;
    }
}

void PatternNetwork::standardize(std::span<const float, BarPatterns::kFeatures> features,
                                 int segments,
                                 std::span<float, kInputs> out) const noexcept RAKS_NONBLOCKING {
    std::copy(features.begin(), features.end(), out.begin());
    out.back() = std::log(static_cast<float>(segments));
    for (std::size_t i = 0; i < out.size(); ++i) {
        // A feature far outside the training data, as in damaged sound, cannot rule the sum.
        out[i] = std::clamp((out[i] - mean[i]) / deviation[i], -kFarthest, kFarthest);
    }
}

void PatternNetwork::log_chances(std::span<const float, kInputs> inputs,
                                 std::span<float> out) const noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(out.size() == classes && units <= kMaxUnits);
    // On the stack: the network may run on the audio thread.
    std::array<float, kMaxUnits> hidden{};
    for (std::size_t unit = 0; unit < units; ++unit) {
        const float* const weights = hidden_weights.data() + unit * kInputs;
        const float sum =
            std::inner_product(inputs.begin(), inputs.end(), weights, hidden_bias[unit]);
        hidden[unit] = std::max(0.0F, sum);
    }
    // Without a hidden layer the output layer takes the inputs (logistic regression).
    const std::span<const float> last =
        units > 0 ? std::span<const float>(hidden).first(units) : std::span<const float>(inputs);
    for (std::size_t c = 0; c < classes; ++c) {
        const float* const weights = output_weights.data() + c * last.size();
        out[c] = std::inner_product(last.begin(), last.end(), weights, output_bias[c]);
    }
    normalize_logs(out);
}

}  // namespace raks::audio
