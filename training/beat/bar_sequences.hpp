#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/networks/mel_augmentation.hpp"
#include "training/networks/network_gradient.hpp"

/// Training material of the bar network: one feature frame a beat, with the beat's place in its
/// bar.
namespace raks::audio {

/// Target classes in the order of the network's outputs; unknown: no target.
enum class BarPlace : std::uint8_t { first, middle, other, unknown };

/// One piece, a frame a beat.
struct BarSequence {
    std::vector<BarInput::Frame> frames;  ///< features of each beat
    std::vector<BarPlace> places;         ///< the target of each frame
};

/// The target of each beat. The middle is the third beat of four, the fourth of six.
[[nodiscard]] std::vector<BarPlace> places_of(const std::vector<PlayedBeat>& beats);

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
