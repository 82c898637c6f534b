#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/beat/network/network_input.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// What the network says of one hop: probabilities, each [0, 1], not exclusive.
struct BeatEvidence {
    float beat = 0.0F;      ///< a beat is here (a downbeat too)
    float downbeat = 0.0F;  ///< the first beat of a bar
    float half = 0.0F;      ///< half way between two beats
};

/// A small recurrent network that hears beats: gated recurrent units (Cho et al. 2014) in layers,
/// and three logistic outputs. Weights only; immutable once built.
///
/// One layer of u units with input x: r = s(x Wr + h Ur + br), z = s(x Wz + h Uz + bz),
/// n = tanh(x Wn + bn + r (h Un + cn)), h' = (1 - z) n + z h.
/// Parameters lie in one row, layer after layer: W (inputs x 3u), U (u x 3u), b (3u), c (u), all
/// row-major with the gates r, z, n side by side; then the output's W (u x 3) and b (3).
/// Threads: any may read.
class BeatNetwork {
 public:
    static constexpr std::size_t kMaxUnits = 128;
    static constexpr std::size_t kMaxLayers = 3;
    static constexpr std::size_t kOutputs = 3;

    struct Layer {
        std::size_t inputs = 0;
        std::size_t units = 0;
        std::size_t input_weights = 0;  ///< where they start in the row of parameters
        std::size_t recurrent_weights = 0;
        std::size_t biases = 0;
        std::size_t candidate_biases = 0;
    };

    /// All parameters 0. `units` of each layer, 1 to kMaxUnits, a multiple of 4; 1 to kMaxLayers
    /// layers. `lookahead`: hops by which its evidence comes after the sound that it is about.
    BeatNetwork(std::size_t units, std::size_t layers, int lookahead);

    [[nodiscard]] std::span<const Layer> layers() const noexcept { return layers_; }
    [[nodiscard]] std::size_t units() const noexcept { return layers_.back().units; }
    [[nodiscard]] std::size_t output_weights() const noexcept { return output_weights_; }
    [[nodiscard]] std::size_t output_biases() const noexcept {
        return output_weights_ + units() * kOutputs;
    }
    [[nodiscard]] int lookahead() const noexcept { return lookahead_; }
    [[nodiscard]] std::span<const float> parameters() const noexcept { return parameters_; }
    [[nodiscard]] std::span<float> parameters() noexcept { return parameters_; }

 private:
    std::vector<Layer> layers_;
    std::size_t output_weights_ = 0;
    int lookahead_ = 0;
    std::vector<float> parameters_;
};

/// The mean of the weights of networks that went on from one and the same: they lie in one valley,
/// and their mean hears like all of them together (Wortsman et al. 2022, "Model soups").
/// Errors: none given, or "3: has another shape than the first", counted from 1.
[[nodiscard]] Expected<BeatNetwork> average(
    std::span<const std::shared_ptr<const BeatNetwork>> networks);

/// Listens with one network, hop by hop.
/// Cost: units x (inputs + units) x 3 multiply-adds a layer; 3 us a hop for two layers of 64.
/// Threads: one. Real-time: next, reset yes.
class BeatListener {
 public:
    explicit BeatListener(std::shared_ptr<const BeatNetwork> network);

    BeatEvidence next(const NetworkInput::Frame& input) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Units = std::array<float, BeatNetwork::kMaxUnits>;
    void step(const BeatNetwork::Layer& layer,
              std::span<const float> input,
              Units& hidden) noexcept;

    std::shared_ptr<const BeatNetwork> network_;
    std::array<Units, BeatNetwork::kMaxLayers> hidden_{};
};

}  // namespace raks::audio
