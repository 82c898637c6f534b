#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "training/beat/corpus.hpp"
#include "training/networks/mel_augmentation.hpp"
#include "training/networks/network_gradient.hpp"

/// Music as the bars' network hears it: beat by beat.
namespace raks::audio {

/// The choice of the network's outputs, in their order; unknown: not learnt from.
enum class BarPlace : std::uint8_t { first, middle, other, unknown };

/// A piece, one frame a beat.
struct BarSequence {
    std::vector<BarInput::Frame> frames;
    std::vector<BarPlace> places;
};

/// The place of each beat. The middle is the third beat of four, the fourth of six.
[[nodiscard]] std::vector<BarPlace> places_of(const std::vector<PlayedBeat>& beats);

/// What is heard of the excerpt from `hearing.first_hop` on, cut into beats where they were played,
/// give or take what a tracker errs. `dice`: draws that and the noise; null: neither.
[[nodiscard]] BarSequence make_bar_sequence(const TrainingExcerpt& excerpt,
                                            const std::shared_ptr<const BeatNetwork>& network,
                                            const MelAugmentation& augmentation,
                                            Dice* dice);

/// `chunks` stretches of `beats` beats from pieces drawn from `from`, one piece after another as on
/// a stage: each piece is one of its hearings. Beats are sometimes left out or counted twice, as a
/// tracker does; single inputs are dropped.
[[nodiscard]] TrainingBatch draw_bar_batch(const std::vector<std::vector<BarSequence>>& from,
                                           std::size_t chunks,
                                           std::size_t beats,
                                           Dice& dice);

/// The first `beats` beats of each, as they are.
[[nodiscard]] TrainingBatch plain_bar_batch(const std::vector<BarSequence>& sequences,
                                            std::size_t beats);

}  // namespace raks::audio
