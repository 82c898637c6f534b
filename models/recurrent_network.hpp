#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/realtime.hpp"

namespace raks::models {

/// A small recurrent network: gated recurrent units (Cho et al. 2014) in layers, and linear
/// outputs. Weights only; what the outputs mean is its owner's.
///
/// One layer of u units with input x: r = s(x Wr + h Ur + br), z = s(x Wz + h Uz + bz),
/// n = tanh(x Wn + bn + r (h Un + cn)), h' = (1 - z) n + z h.
/// Parameters lie in one row, layer after layer: W (inputs x 3u), U (u x 3u), b (3u), c (u), all
/// row-major with the gates r, z, n side by side; then the output's W (u x outputs) and b
/// (outputs). Threads: any may read.
class RecurrentNetwork {
 public:
    static constexpr std::size_t kMaxUnits = 128;
    static constexpr std::size_t kMaxLayers = 3;
    static constexpr std::size_t kMaxOutputs = 17;

    struct Shape {
        std::size_t inputs = 1;
        std::size_t units = 4;    ///< of each layer, 1 to kMaxUnits; multiples of 4 are fast
        std::size_t layers = 1;   ///< 1 to kMaxLayers
        std::size_t outputs = 1;  ///< 1 to kMaxOutputs
        friend bool operator==(const Shape&, const Shape&) = default;
    };
    struct Layer {
        std::size_t inputs = 0;
        std::size_t units = 0;
        std::size_t input_weights = 0;  ///< where they start in the row of parameters
        std::size_t recurrent_weights = 0;
        std::size_t biases = 0;
        std::size_t candidate_biases = 0;
    };

    /// All parameters 0.
    explicit RecurrentNetwork(const Shape& shape);

    [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
    [[nodiscard]] std::span<const Layer> layers() const noexcept { return layers_; }
    [[nodiscard]] std::size_t units() const noexcept { return shape_.units; }
    [[nodiscard]] std::size_t outputs() const noexcept { return shape_.outputs; }
    [[nodiscard]] std::size_t output_weights() const noexcept { return output_weights_; }
    [[nodiscard]] std::size_t output_biases() const noexcept {
        return output_weights_ + units() * outputs();
    }
    [[nodiscard]] std::span<const float> parameters() const noexcept { return parameters_; }
    [[nodiscard]] std::span<float> parameters() noexcept { return parameters_; }

 private:
    Shape shape_;
    std::vector<Layer> layers_;
    std::size_t output_weights_ = 0;
    std::vector<float> parameters_;
};

/// Runs a network over a stream, frame by frame, from zero states.
/// Cost: units x (inputs + units) x 3 multiply-adds a layer; 3 us a frame for two layers of 64.
/// Threads: one. Real-time: next, reset yes.
class RecurrentStream {
 public:
    using Logits = std::array<float, RecurrentNetwork::kMaxOutputs>;

    /// The outputs after this frame, before any squashing; those that the network lacks are 0.
    /// `network`: the same shape every time. `input`: its inputs.
    Logits next(const RecurrentNetwork& network,
                std::span<const float> input) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { hidden_ = {}; }

 private:
    using Units = std::array<float, RecurrentNetwork::kMaxUnits>;
    std::array<Units, RecurrentNetwork::kMaxLayers> hidden_{};
};

}  // namespace raks::models
