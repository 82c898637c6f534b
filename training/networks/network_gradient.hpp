#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "models/recurrent_network.hpp"

namespace raks::audio {

/// A batch of sequences ("chunks") of equal length, step by step: inputs[(t * chunks + b) * inputs
/// a frame].
struct TrainingBatch {
    std::size_t steps = 0;       ///< length of each chunk in frames
    std::size_t chunks = 0;      ///< sequences side by side
    std::vector<float> inputs;   ///< steps x chunks x the network's inputs
    std::vector<float> targets;  ///< steps x chunks x its outputs, each 0 to 1
    std::vector<float> weights;  ///< of each target in the loss, the same shape
    /// logistic: each output is a probability of its own (binary cross-entropy). softmax: the
    /// outputs together are one choice (cross-entropy).
    enum class Loss : std::uint8_t { logistic, softmax };
    Loss loss = Loss::logistic;  ///< of all outputs
};

/// Weighted cross-entropy of a batch, summed over outputs and frames, and its gradient by every
/// parameter: backpropagation through time over the whole chunk, from zero states. Keeps its
/// buffers from call to call.
/// Threads: one. Real-time: no.
class NetworkGradient {
 public:
    /// Adds the gradient of this batch's summed loss to `gradient` (one number a parameter); empty:
    /// computes the loss alone. Returns the summed loss, in nats, not divided by frames.
    double accumulate(const models::RecurrentNetwork& network,
                      const TrainingBatch& batch,
                      std::span<float> gradient);

 private:
    struct LayerTrace {
        std::vector<float> projected;  // steps x chunks x 3 units, becomes the gradient of it
        std::vector<float> recurrent;  // gradient of the recurrent product, the same shape
        std::vector<float> reset, keep, candidate, product;  // steps x chunks x units
        std::vector<float> hidden;  // (steps + 1) x chunks x units: the first is 0
    };
    void forward(const models::RecurrentNetwork& network,
                 std::size_t layer,
                 const float* below,
                 const TrainingBatch& batch);
    void backward(const models::RecurrentNetwork& network,
                  std::size_t layer,
                  const float* below,
                  const TrainingBatch& batch,
                  std::vector<float>& from_above,
                  std::span<float> gradient);
    void forward_outputs(const models::RecurrentNetwork& network, const TrainingBatch& batch);

    std::vector<LayerTrace> traces_;
    std::vector<float> output_gradient_;  // steps x chunks x outputs
    std::vector<float> from_above_;       // steps x chunks x units
};

/// Draws all parameters uniformly from +-1 / sqrt(units). The same seed gives the same weights.
void initialize(models::RecurrentNetwork& network, std::uint64_t seed);

}  // namespace raks::audio
