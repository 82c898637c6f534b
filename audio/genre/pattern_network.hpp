#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/genre/bar_patterns.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// A classifier of a window's bar patterns: one hidden layer of rectified linear units over
/// standardized features, or none (logistic regression). Immutable while it is used.
struct PatternNetwork {
    /// Number of inputs: the features, then the logarithm of the window's length in segments.
    static constexpr std::size_t kInputs = BarPatterns::kFeatures + 1;
    static constexpr std::size_t kMaxUnits = 128;   ///< of the hidden layer
    static constexpr std::size_t kMaxClasses = 17;  ///< genres and none of them
    static constexpr float kFarthest = 4.0F;        ///< standard deviations: bound of the inputs

    std::size_t units = 0;              ///< 0: no hidden layer
    std::size_t classes = 0;            ///< number of outputs
    std::vector<float> mean;            ///< of each input in training, kInputs
    std::vector<float> deviation;       ///< of each input in training, kInputs, > 0
    std::vector<float> hidden_weights;  ///< units x kInputs, row-major
    std::vector<float> hidden_bias;     ///< units
    std::vector<float> output_weights;  ///< classes x (units, or kInputs without any), row-major
    std::vector<float> output_bias;     ///< classes

    /// Number of inputs of the output layer.
    [[nodiscard]] std::size_t last_inputs() const noexcept { return units > 0 ? units : kInputs; }

    /// Standardizes a window's features and appends the logarithm of its length. `segments`: length
    /// in half seconds. Values are clamped to +-kFarthest. Real-time: yes.
    void standardize(std::span<const float, BarPatterns::kFeatures> features,
                     int segments,
                     std::span<float, kInputs> out) const noexcept RAKS_NONBLOCKING;
    /// ln probability of each class, from standardized inputs. `out`: `classes` values. Real-time:
    /// yes.
    void log_chances(std::span<const float, kInputs> inputs,
                     std::span<float> out) const noexcept RAKS_NONBLOCKING;
};

/// Subtracts ln of the sum of exp from each value, so that exp of the values sums to 1. `logs`: at
/// least one value. Real-time: yes.
void normalize_logs(std::span<float> logs) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
