#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "training/networks/adam.hpp"
#include "training/networks/network_gradient.hpp"

namespace raks::audio {

/// Minimizes the loss of a network with Adam; gradients longer than 1 are scaled to length 1 first.
/// A batch is computed in shards whose gradients are summed in a fixed order: the same draws give
/// the same weights on one machine, for any number of threads.
/// Threads: one caller; it starts workers. Real-time: no.
class NetworkDescent {
 public:
    /// Parts of a batch; fixed, so that threads do not change the sums.
    static constexpr std::size_t kShards = 4;

    /// `network`: must outlive this; starts from its present weights.
    NetworkDescent(models::RecurrentNetwork& network, int threads);

    /// Takes one step at Adam's `rate`. `draw(shard)` returns part of the batch, drawn from a
    /// stream of random numbers of its own; it is called from several threads. Returns the mean
    /// loss a frame.
    double step(double rate, const std::function<TrainingBatch(std::size_t shard)>& draw);
    /// Mean loss a frame of these batches, without training; 0 for no frames.
    [[nodiscard]] double loss_of(std::span<const TrainingBatch> batches) const;

 private:
    models::RecurrentNetwork& network_;
    int threads_;
    Adam<float> adam_;
    std::array<NetworkGradient, kShards> gradients_;
};

/// Learning rate of a step: linear warm-up over 30 steps, times a cosine from `highest` to 0 at
/// `steps`.
[[nodiscard]] double rate_at(double highest, int step, int steps);

}  // namespace raks::audio
