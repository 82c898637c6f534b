#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/realtime.hpp"

namespace raks::models {

/// A small recurrent network: layers of gated recurrent units (Cho et al. 2014) and linear outputs.
/// It holds weights only; what inputs and outputs mean is up to its user.
///
/// One layer of u units with input x: r = s(x Wr + h Ur + br), z = s(x Wz + h Uz + bz),
/// n = tanh(x Wn + bn + r (h Un + cn)), h' = (1 - z) n + z h; s is the logistic function.
/// Parameters lie in one row, layer after layer: W (inputs x 3u), U (u x 3u), b (3u), c (u), all
/// row-major with the gates r, z, n side by side; then the output's W (u x outputs) and b
/// (outputs). Threads: any may read.
class RecurrentNetwork {
 public:
    static constexpr std::size_t kMaxUnits = 128;   ///< of a layer: the size of a stream's state
    static constexpr std::size_t kMaxLayers = 3;    ///< of a network
    static constexpr std::size_t kMaxOutputs = 18;  ///< size of Logits

    /// Sizes of a network.
    struct Shape {
        std::size_t inputs = 1;   ///< numbers in a frame
        std::size_t units = 4;    ///< of each layer, 1 to kMaxUnits; multiples of 4 are fast
        std::size_t layers = 1;   ///< 1 to kMaxLayers
        std::size_t outputs = 1;  ///< 1 to kMaxOutputs
        friend bool operator==(const Shape&, const Shape&) = default;
    };
    /// Sizes of a layer and where its parameters start in the row.
    struct Layer {
        std::size_t inputs = 0;             ///< of the frame, or units of the layer below
        std::size_t units = 0;              ///< u
        std::size_t input_weights = 0;      ///< index of W, inputs x 3u
        std::size_t recurrent_weights = 0;  ///< index of U, u x 3u
        std::size_t biases = 0;             ///< index of b, 3u
        std::size_t candidate_biases = 0;   ///< index of c, u
    };

    /// Checks the shape by assertion; all parameters are 0.
    explicit RecurrentNetwork(const Shape& shape);

    [[nodiscard]] const Shape& shape() const noexcept { return shape_; }  ///< as given
    /// From input to output.
    [[nodiscard]] std::span<const Layer> layers() const noexcept { return layers_; }
    [[nodiscard]] std::size_t units() const noexcept { return shape_.units; }  ///< of each layer
    /// Numbers for each frame.
    [[nodiscard]] std::size_t outputs() const noexcept { return shape_.outputs; }
    /// Index of the output weights in the row of parameters.
    [[nodiscard]] std::size_t output_weights() const noexcept { return output_weights_; }
    /// Index of the output biases.
    [[nodiscard]] std::size_t output_biases() const noexcept {
        return output_weights_ + units() * outputs();
    }
    /// All, in one row.
    [[nodiscard]] std::span<const float> parameters() const noexcept { return parameters_; }
    [[nodiscard]] std::span<float> parameters() noexcept { return parameters_; }  ///< to be set

 private:
    Shape shape_;
    std::vector<Layer> layers_;
    std::size_t output_weights_ = 0;
    std::vector<float> parameters_;
};

/// State of a network on one stream; runs it frame by frame from zero states.
/// Cost: units x (inputs + units) x 3 multiply-adds a layer; 18,000 instructions (AVX2) a frame of
/// 54 inputs and two layers of 64. Threads: one. Real-time: next, reset yes.
class RecurrentStream {
 public:
    /// Outputs before any squashing.
    using Logits = std::array<float, RecurrentNetwork::kMaxOutputs>;

    /// The outputs after this frame; entries beyond the network's outputs are 0. `network`: of the
    /// same shape at every call. `input`: as many numbers as it has inputs.
    Logits next(const RecurrentNetwork& network,
                std::span<const float> input) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING { hidden_ = {}; }  ///< back to zero states

 private:
    using Units = std::array<float, RecurrentNetwork::kMaxUnits>;
    std::array<Units, RecurrentNetwork::kMaxLayers> hidden_{};
};

/// Runs one network on a stream, frame by frame. `Network` is a RecurrentNetwork that names its
/// `Frame` (the input) and its `Evidence` (the output), and converts the raw outputs: `static
/// Evidence evidence_of(const RecurrentStream::Logits&) noexcept`.
/// Threads: one. Real-time: next, reset yes.
template <class Network>
class NetworkStream {
 public:
    /// `network`: not null; shared with other streams.
    explicit NetworkStream(std::shared_ptr<const Network> network) : network_(std::move(network)) {}

    /// Output after this frame. It describes the frame that lies the network's look-ahead before
    /// it.
    typename Network::Evidence next(const typename Network::Frame& frame) noexcept
        RAKS_NONBLOCKING {
        return Network::evidence_of(stream_.next(*network_, frame));
    }
    void reset() noexcept RAKS_NONBLOCKING { stream_.reset(); }  ///< back to zero states

 private:
    std::shared_ptr<const Network> network_;
    RecurrentStream stream_;
};

}  // namespace raks::models
