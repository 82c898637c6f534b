#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/genre/bar_patterns.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Which class a window's bar patterns look like: one hidden layer of rectified units over
/// standardized features, or none (logistic regression). Trained by audio/genre/training. A value;
/// immutable while it listens.
struct PatternNetwork {
    /// The features, then the logarithm of the window's length in segments.
    static constexpr std::size_t kInputs = BarPatterns::kFeatures + 1;
    static constexpr std::size_t kMaxUnits = 128;
    static constexpr std::size_t kMaxClasses = 17;
    static constexpr float kFarthest = 4.0F;  ///< standard deviations: inputs are clamped there

    std::size_t units = 0;  ///< 0: no hidden layer
    std::size_t classes = 0;
    std::vector<float> mean;            ///< kInputs
    std::vector<float> deviation;       ///< kInputs, > 0
    std::vector<float> hidden_weights;  ///< units x kInputs, row-major
    std::vector<float> hidden_bias;     ///< units
    std::vector<float> output_weights;  ///< classes x (units, or kInputs without any), row-major
    std::vector<float> output_bias;     ///< classes

    /// What the output weights are about.
    [[nodiscard]] std::size_t last_inputs() const noexcept { return units > 0 ? units : kInputs; }

    /// Standardized and clamped inputs. Real-time: yes.
    void standardize(std::span<const float, BarPatterns::kFeatures> features,
                     int segments,
                     std::span<float, kInputs> out) const noexcept RAKS_NONBLOCKING;
    /// ln of each class' chance, from standardized inputs. Real-time: yes.
    void log_chances(std::span<const float, kInputs> inputs,
                     std::span<float> out) const noexcept RAKS_NONBLOCKING;
};

/// Subtracts ln sum exp, so that exp sums to 1. Real-time: yes.
void normalize_logs(std::span<float> logs) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
