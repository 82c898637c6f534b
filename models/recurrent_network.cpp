#include "models/recurrent_network.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"
#include "base/simd_clones.hpp"
#include "models/dense_product.hpp"
#include "models/gates.hpp"

namespace raks::models {
namespace {

using Units = std::array<float, RecurrentNetwork::kMaxUnits>;

/// hidden = the next hidden values, from the sums of both products (gates r, z, n side by side).
RAKS_SIMD_CLONES void open_gates(const float* from_input,
                                 const float* from_hidden,
                                 std::size_t units,
                                 float* __restrict hidden) noexcept {
    // fast_tanh() and logistic(), with the clamping in loops of its own: so all are vectorized.
    std::array<float, 2 * RecurrentNetwork::kMaxUnits> gates;   // NOLINT: filled below
    std::array<float, RecurrentNetwork::kMaxUnits> candidates;  // NOLINT: filled below
    for (std::size_t i = 0; i < 2 * units; ++i) {
        gates[i] = gate_range(from_input[i] + from_hidden[i]);
    }
    for (std::size_t i = 0; i < 2 * units; ++i) {
        gates[i] = logistic_in_range(gates[i]);
    }
    for (std::size_t i = 0; i < units; ++i) {
        candidates[i] =
            gate_range(2.0F * (from_input[2 * units + i] + gates[i] * from_hidden[2 * units + i]));
    }
    for (std::size_t i = 0; i < units; ++i) {
        const float keep = gates[units + i];
        const float candidate = 2.0F * logistic_in_range(candidates[i]) - 1.0F;
        hidden[i] = (1.0F - keep) * candidate + keep * hidden[i];
    }
}

// One layer, one frame. Biases are the start values of the sums: b with the input's product, c with
// the candidate's recurrent product only, because r multiplies that one.
void step(const float* parameters,
          const RecurrentNetwork::Layer& layer,
          std::span<const float> input,
          Units& hidden) noexcept {
    std::array<float, 3 * RecurrentNetwork::kMaxUnits> from_input;   // NOLINT: filled below
    std::array<float, 3 * RecurrentNetwork::kMaxUnits> from_hidden;  // NOLINT: filled below
    const std::size_t width = 3 * layer.units;
    std::copy_n(parameters + layer.biases, width, from_input.begin());
    std::fill_n(from_hidden.begin(), 2 * layer.units, 0.0F);
    std::copy_n(parameters + layer.candidate_biases,
                layer.units,
                from_hidden.begin() + static_cast<std::ptrdiff_t>(2 * layer.units));
    add_product(
        input.data(), layer.inputs, parameters + layer.input_weights, width, from_input.data());
    add_product(hidden.data(),
                layer.units,
                parameters + layer.recurrent_weights,
                width,
                from_hidden.data());
    open_gates(from_input.data(), from_hidden.data(), layer.units, hidden.data());
}

}  // namespace

RecurrentNetwork::RecurrentNetwork(const Shape& shape) : shape_(shape) {
    RAKS_ASSERT(shape.units >= 1 && shape.units <= kMaxUnits && shape.layers >= 1 &&
                shape.layers <= kMaxLayers && shape.outputs >= 1 && shape.outputs <= kMaxOutputs);
    // Deals out consecutive ranges of the row of parameters.
    std::size_t at = 0;
    const auto take = [&](std::size_t count) { return std::exchange(at, at + count); };
    std::size_t inputs = shape.inputs;  // of the layer: of the frame, then of the layer below
    for (std::size_t i = 0; i < shape.layers; ++i) {
        Layer layer{.inputs = inputs, .units = shape.units};
        layer.input_weights = take(inputs * 3 * shape.units);
        layer.recurrent_weights = take(shape.units * 3 * shape.units);
        layer.biases = take(3 * shape.units);
        layer.candidate_biases = take(shape.units);
        layers_.push_back(layer);
        inputs = shape.units;
    }
    output_weights_ = take(shape.units * shape.outputs);
    take(shape.outputs);  // the output biases
    parameters_.resize(at);
}

// The output of each layer is the input of the next; the last one feeds the outputs.
RecurrentStream::Logits RecurrentStream::next(
    const RecurrentNetwork& network, std::span<const float> input) noexcept RAKS_NONBLOCKING {
    const float* const parameters = network.parameters().data();
    std::span<const float> below = input;
    std::size_t index = 0;
    for (const RecurrentNetwork::Layer& layer : network.layers()) {
        step(parameters, layer, below, hidden_[index]);
        below = std::span<const float>(hidden_[index]).first(layer.units);
        ++index;
    }
    // The logits start at the biases; entries beyond the network's outputs stay 0.
    Logits logits{};
    std::copy_n(parameters + network.output_biases(), network.outputs(), logits.begin());
    add_product(below.data(),
                below.size(),
                parameters + network.output_weights(),
                network.outputs(),
                logits.data());
    return logits;
}

}  // namespace raks::models
