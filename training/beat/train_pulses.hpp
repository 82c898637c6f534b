#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "audio/beat/network/pulse_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_network.hpp"
#include "training/networks/mel_augmentation.hpp"

/// Training of the pulse network, which tells from a pulse that is followed which one is the beat.
namespace raks::audio {

/// Shape of the network and schedule of its training.
struct PulsePlan {
    std::size_t units = 64;  ///< of gated recurrent units, of each layer
    std::size_t layers = 1;  ///< of the network
    int copies = 6;          ///< of each piece: each follows another pulse, and all are augmented
    int steps = 1500;        ///< batches of 48 chunks of 64 beats
    double rate = 6e-3;  ///< highest learning rate (Adam); warm-up of 30 steps, then a cosine to 0
    std::uint64_t seed = 1;  ///< of weights and draws
    int threads = 2;         ///< any number gives the same weights
};

/// Trains a pulse network. Every 16th excerpt is kept for validation, as in train_network; losses
/// are means a beat. The same plan and corpus give the same weights on one machine, for any number
/// of threads. `report` is called every 100 steps. Without an excerpt that has even beats: the
/// initial network.
/// Threads: workers. Real-time: no.
PulseNetwork train_pulses(
    const std::vector<TrainingExcerpt>& corpus,
    const PulsePlan& plan,
    const std::function<void(const NetworkProgress&, const PulseNetwork&)>& report);

/// A piece as a tracker follows it that may be wrong, a frame a beat of the followed pulse.
struct PulseSequence {
    std::vector<PulseInput::Frame> frames;  ///< features of each beat
    std::vector<std::size_t> places;        ///< which of PulseEvidence is the beat of the music
};

/// Computes the features of a piece while a wrong pulse is followed, or the right one. `pulse`:
/// which of PulseEvidence is the beat of the music as seen from what is followed; `shift`: beats of
/// the music, where rates allow several places. `dice`: draws the tracking error and the noise;
/// null: neither.
[[nodiscard]] PulseSequence make_pulse_sequence(const TrainingExcerpt& excerpt,
                                                std::size_t pulse,
                                                int shift,
                                                const MelAugmentation& augmentation,
                                                Dice* dice);

}  // namespace raks::audio
