#include "audio/beat/network/beat_network.hpp"

#include <utility>

#include "audio/math/gates.hpp"
#include "base/assert.hpp"
#include "base/simd_clones.hpp"

namespace raks::audio {
namespace {

/// sums[j] += sum over i of input[i] weights[i][j]
RAKS_SIMD_CLONES void add_product(const float* input,
                                  std::size_t inputs,
                                  const float* weights,
                                  std::size_t width,
                                  float* __restrict sums) noexcept {
    for (std::size_t i = 0; i < inputs; ++i) {
        const float x = input[i];
        const float* const row = weights + i * width;
        for (std::size_t j = 0; j < width; ++j) {
            sums[j] += x * row[j];
        }
    }
}

/// hidden = the next hidden, from both products' sums (gates r, z, n side by side).
RAKS_SIMD_CLONES void open_gates(const float* from_input,
                                 const float* from_hidden,
                                 std::size_t units,
                                 float* __restrict hidden) noexcept {
    for (std::size_t i = 0; i < units; ++i) {
        const float reset = logistic(from_input[i] + from_hidden[i]);
        const float keep = logistic(from_input[units + i] + from_hidden[units + i]);
        const float candidate =
            fast_tanh(from_input[2 * units + i] + reset * from_hidden[2 * units + i]);
        hidden[i] = (1.0F - keep) * candidate + keep * hidden[i];
    }
}

}  // namespace

BeatNetwork::BeatNetwork(std::size_t units, std::size_t layers, int lookahead)
    : lookahead_(lookahead) {
    RAKS_ASSERT(units >= 1 && units <= kMaxUnits && layers >= 1 && layers <= kMaxLayers);
    std::size_t at = 0;
    const auto take = [&](std::size_t count) { return std::exchange(at, at + count); };
    std::size_t inputs = NetworkInput::kSize;
    for (std::size_t i = 0; i < layers; ++i) {
        Layer layer{.inputs = inputs, .units = units};
        layer.input_weights = take(inputs * 3 * units);
        layer.recurrent_weights = take(units * 3 * units);
        layer.biases = take(3 * units);
        layer.candidate_biases = take(units);
        layers_.push_back(layer);
        inputs = units;
    }
    output_weights_ = take(units * kOutputs);
    take(kOutputs);
    parameters_.resize(at);
}

Expected<BeatNetwork> average(std::span<const std::shared_ptr<const BeatNetwork>> networks) {
    if (networks.empty()) {
        return fail("0: there is none");
    }
    const BeatNetwork& first = *networks.front();
    BeatNetwork mean(first.units(), first.layers().size(), first.lookahead());
    for (std::size_t n = 0; n < networks.size(); ++n) {
        const BeatNetwork& one = *networks[n];
        if (one.units() != mean.units() || one.layers().size() != mean.layers().size() ||
            one.lookahead() != mean.lookahead()) {
            return fail(std::to_string(n + 1) + ": has another shape than the first");
        }
        for (std::size_t i = 0; i < one.parameters().size(); ++i) {
            mean.parameters()[i] += one.parameters()[i] / static_cast<float>(networks.size());
        }
    }
    return mean;
}

BeatListener::BeatListener(std::shared_ptr<const BeatNetwork> network)
    : network_(std::move(network)) {}

void BeatListener::reset() noexcept RAKS_NONBLOCKING { hidden_ = {}; }

void BeatListener::step(const BeatNetwork::Layer& layer,
                        std::span<const float> input,
                        Units& hidden) noexcept {
    const float* const parameters = network_->parameters().data();
    std::array<float, 3 * BeatNetwork::kMaxUnits> from_input;   // NOLINT: filled below
    std::array<float, 3 * BeatNetwork::kMaxUnits> from_hidden;  // NOLINT: filled below
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

BeatEvidence BeatListener::next(const NetworkInput::Frame& input) noexcept RAKS_NONBLOCKING {
    std::span<const float> below = input;
    std::size_t index = 0;
    for (const BeatNetwork::Layer& layer : network_->layers()) {
        step(layer, below, hidden_[index]);
        below = std::span<const float>(hidden_[index]).first(layer.units);
        ++index;
    }
    std::array<float, BeatNetwork::kOutputs> logits{};
    const float* const parameters = network_->parameters().data();
    std::copy_n(parameters + network_->output_biases(), logits.size(), logits.begin());
    add_product(below.data(),
                below.size(),
                parameters + network_->output_weights(),
                logits.size(),
                logits.data());
    return {logistic(logits[0]), logistic(logits[1]), logistic(logits[2])};
}

}  // namespace raks::audio
