#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_network.hpp"
#include "training/networks/mel_augmentation.hpp"
#include "training/networks/network_gradient.hpp"

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

// Training material of the bar network: one feature frame a beat, with the beat's place in its
// bar.

/// Target classes in the order of the network's outputs; unknown: no target.
enum class BarTarget : std::uint8_t { first, middle, other, unknown };

/// One piece, a frame a beat.
struct BarSequence {
    std::vector<BarInput::Frame> frames;  ///< features of each beat
    std::vector<BarTarget> places;        ///< the target of each frame
};

/// The target of each beat. The middle is the third beat of four, the fourth of six.
[[nodiscard]] std::vector<BarTarget> places_of(const std::vector<PlayedBeat>& beats);

/// Computes the features of the excerpt from `hearing.first_hop` on, augmented as `hearing` says
/// and cut at the annotated beats plus a simulated tracking error. `dice`: draws that error and the
/// noise; null: neither.
[[nodiscard]] BarSequence make_bar_sequence(const TrainingExcerpt& excerpt,
                                            const std::shared_ptr<const BeatNetwork>& network,
                                            const MelAugmentation& augmentation,
                                            Dice* dice);

/// Draws a batch of `chunks` stretches of `beats` beats. Pieces drawn from `from` follow one
/// another within a stretch; of each piece one of its augmented versions is drawn. As a tracker
/// would, it sometimes leaves a beat out or repeats one; single inputs are dropped (dropout).
[[nodiscard]] TrainingBatch draw_bar_batch(const std::vector<std::vector<BarSequence>>& from,
                                           std::size_t chunks,
                                           std::size_t beats,
                                           Dice& dice);

/// The first `beats` beats of each sequence, without draws: for validation.
[[nodiscard]] TrainingBatch plain_bar_batch(const std::vector<BarSequence>& sequences,
                                            std::size_t beats);

}  // namespace raks::audio
