#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_network.hpp"

namespace raks::audio {

struct BarPlan {
    std::size_t units = 48;
    std::size_t layers = 1;
    int copies = 2;      ///< of each piece, each through other rooms and noise; the first is plain
    int steps = 1200;    ///< of batches of 48 chunks of 96 beats
    double rate = 6e-3;  ///< of Adam at its highest; warm-up of 30 steps, then a cosine to 0
    std::uint64_t seed = 1;
    int threads = 2;
};

/// Trains a network that hears bars from what `beats` says of the corpus. Every 16th excerpt is
/// kept for validation, as in train_network; losses are means a beat. The same plan, corpus and
/// network of beats give the same weights on one machine, for any number of threads.
BarNetwork train_bars(const std::vector<TrainingExcerpt>& corpus,
                      const std::shared_ptr<const BeatNetwork>& beats,
                      const BarPlan& plan,
                      const std::function<void(const NetworkProgress&, const BarNetwork&)>& report);

}  // namespace raks::audio
