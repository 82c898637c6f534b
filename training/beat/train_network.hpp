#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/beat_network.hpp"
#include "training/beat/corpus.hpp"

namespace raks::audio {

struct NetworkPlan {
    std::size_t units = 64;
    std::size_t layers = 2;
    int lookahead = 2;         ///< hops of 10 ms
    int steps = 4000;          ///< of batches of 24 chunks of 10 s; then 1/7 as many of 16 of 20 s
    double rate = 5e-3;        ///< of Adam at its highest; warm-up of 30 steps, then a cosine to 0
    double cut_chance = 0.33;  ///< that another piece begins within a chunk; [0, 1]
    std::uint64_t seed = 1;
    std::shared_ptr<const BeatNetwork> start;  ///< weights to go on from; its units, layers and
                                               ///< lookahead count. None: drawn by the seed
    int threads = 2;
};

/// How well it does on the excerpts that are kept for validation (every 16th): mean binary
/// cross-entropy a hop.
struct NetworkProgress {
    int step = 0;
    int steps = 0;
    double training_loss = 0.0;  ///< mean since the last report; the outputs' sum
    double validation_loss = 0.0;
};

/// Trains a beat network on a corpus. Every batch is heard through drawn augmentations: bands
/// raised, damped and dropped, noise, time stretched by up to 16 %. The same plan and corpus give
/// the same weights on one machine, for any number of threads. `report` gets the network as it is
/// so far, every 100 steps.
BeatNetwork train_network(
    const std::vector<TrainingExcerpt>& corpus,
    const NetworkPlan& plan,
    const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report);

}  // namespace raks::audio
