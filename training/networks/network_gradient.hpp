#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "models/recurrent_network.hpp"

namespace raks::audio {

/// A batch of chunks of equal length, step by step: inputs[(t * chunks + b) * inputs per frame].
struct TrainingBatch {
    std::size_t steps = 0;
    std::size_t chunks = 0;
    std::vector<float> inputs;   ///< steps x chunks x the network's inputs
    std::vector<float> targets;  ///< steps x chunks x its outputs, each 0 to 1
    std::vector<float> weights;  ///< of each target in the loss, the same shape
    /// logistic: each output is a chance of its own, binary cross-entropy. softmax: together they
    /// are one choice, cross-entropy.
    enum class Loss : std::uint8_t { logistic, softmax };
    Loss loss = Loss::logistic;
};

/// Weighted cross-entropy of a batch, a sum over outputs and frames, and its gradient by every
/// parameter, backward through time over the whole chunk.
class NetworkGradient {
 public:
    /// Adds the gradient of this batch's summed loss to `gradient` (as long as the parameters);
    /// empty: only the loss. Returns the summed loss (not divided by frames).
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

/// Adam (Kingma, Ba 2015), with the gradient's norm held below 1.
class Adam {
 public:
    explicit Adam(std::size_t parameters) : mean_(parameters), square_(parameters) {}
    void step(std::span<float> gradient, double rate, std::span<float> parameters);

 private:
    std::vector<float> mean_;
    std::vector<float> square_;
    std::int64_t steps_ = 0;
};

/// Uniform weights in +-1 / sqrt(units).
void initialize(models::RecurrentNetwork& network, std::uint64_t seed);

}  // namespace raks::audio
