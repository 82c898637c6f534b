#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/beat_network.hpp"
#include "base/dice.hpp"
#include "training/beat/corpus.hpp"
#include "training/networks/network_gradient.hpp"

/// Training of the beat network.
namespace raks::audio {

/// Shape of the network and schedule of its training.
struct NetworkPlan {
    std::size_t units = 64;  ///< of gated recurrent units, of each layer
    std::size_t layers = 2;  ///< of the network
    int lookahead = 2;       ///< hops of 10 ms by which the outputs lag behind the input
    int steps = 4000;    ///< batches of 24 chunks of 10 s; then 1/7 as many of 16 chunks of 20 s
    double rate = 5e-3;  ///< highest learning rate (Adam); warm-up of 30 steps, then a cosine to 0
    double cut_chance = 0.33;  ///< chance that a second piece begins within a chunk; [0, 1]
    std::uint64_t seed = 1;    ///< of weights and draws
    /// Network to continue from; its units, layers and lookahead replace those above. Null: weights
    /// are drawn by the seed.
    std::shared_ptr<const BeatNetwork> start;
    int threads = 2;  ///< any number gives the same weights
};

/// Losses so far: binary cross-entropy a hop, summed over the outputs. Validation is on every 16th
/// excerpt.
struct NetworkProgress {
    int step = 0;                  ///< batches done
    int steps = 0;                 ///< batches in all
    double training_loss = 0.0;    ///< mean since the last report
    double validation_loss = 0.0;  ///< mean over the excerpts kept for validation
};

/// Trains a beat network on a corpus of at least two excerpts with sound. Batches are augmented at
/// random: band gains, damped and dropped bands, noise, time stretched by up to 16 %. The same plan
/// and corpus give the same weights on one machine, for any number of threads. `report` gets the
/// network trained so far, every 100 steps.
/// Threads: workers. Real-time: no.
BeatNetwork train_network(
    const std::vector<TrainingExcerpt>& corpus,
    const NetworkPlan& plan,
    const std::function<void(const NetworkProgress&, const BeatNetwork&)>& report);

/// Draws a batch of `chunks` stretches of `hops` hops from `from` (not empty), randomly augmented.
/// With chance `cut_chance` a second excerpt begins within a chunk. Targets lie `lookahead` hops
/// late.
/// Threads: any, each with its own dice.
[[nodiscard]] TrainingBatch draw_batch(const std::vector<const TrainingExcerpt*>& from,
                                       std::size_t chunks,
                                       std::size_t hops,
                                       int lookahead,
                                       double cut_chance,
                                       Dice& dice);

/// The first `hops` hops of `excerpts` without augmentation, one chunk each: for validation.
[[nodiscard]] TrainingBatch plain_batch(const std::vector<const TrainingExcerpt*>& excerpts,
                                        std::size_t hops,
                                        int lookahead);

}  // namespace raks::audio
