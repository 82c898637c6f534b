#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "training/networks/network_gradient.hpp"

namespace raks::audio {

/// Steps down the loss of a network with Adam. A batch is drawn and learnt from in shards, which
/// are summed in order: the same draws give the same weights on one machine, for any number of
/// threads.
class NetworkDescent {
 public:
    static constexpr std::size_t kShards = 4;

    /// `network`: outlives this; has its first weights.
    NetworkDescent(models::RecurrentNetwork& network, int threads);

    /// One step at Adam's `rate`. `draw(shard)`: a part of the batch, drawn from a stream of random
    /// numbers of its own; called from several threads. Returns the mean loss a frame.
    double step(double rate, const std::function<TrainingBatch(std::size_t shard)>& draw);
    /// Mean loss a frame of these batches; nothing is learnt.
    [[nodiscard]] double loss_of(std::span<const TrainingBatch> batches) const;

 private:
    models::RecurrentNetwork& network_;
    int threads_;
    Adam adam_;
    std::array<NetworkGradient, kShards> gradients_;
};

/// Adam's rate for a step: `highest` after a warm-up of 30 steps, then a cosine to 0 at `steps`.
[[nodiscard]] double rate_at(double highest, int step, int steps);

}  // namespace raks::audio
