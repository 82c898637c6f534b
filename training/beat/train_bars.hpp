#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_network.hpp"

/// Training of the bar network, which classifies each beat by its place in the bar.
namespace raks::audio {

/// Shape of the network and schedule of its training.
struct BarPlan {
    std::size_t units = 48;  ///< of gated recurrent units, of each layer
    std::size_t layers = 1;  ///< of the network
    int copies = 2;          ///< versions of each piece: the first plain, the others augmented
    int steps = 1200;        ///< batches of 48 chunks of 96 beats
    double rate = 6e-3;  ///< highest learning rate (Adam); warm-up of 30 steps, then a cosine to 0
    std::uint64_t seed = 1;  ///< of weights and draws
    int threads = 2;         ///< any number gives the same weights
};

/// Trains a bar network on the features that the beat network `beats` gives of the corpus. Every
/// 16th excerpt is kept for validation, as in train_network; losses are means a beat. The same
/// plan, corpus and beat network give the same weights on one machine, for any number of threads.
/// `report` is called every 100 steps. Without an excerpt that has bars: the initial network.
/// Threads: workers. Real-time: no.
BarNetwork train_bars(const std::vector<TrainingExcerpt>& corpus,
                      const std::shared_ptr<const BeatNetwork>& beats,
                      const BarPlan& plan,
                      const std::function<void(const NetworkProgress&, const BarNetwork&)>& report);

}  // namespace raks::audio
