#pragma once

#include <vector>

#include "audio/beat/training/sound_augmentation.hpp"
#include "audio/math/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Room, band limit, noise, another sampling rate, a lossy codec (MP3 or Opus of 16 to 96 kbit/s),
/// and what the beat tracker's training does (voice, equalizer, overdrive, gain), at random, mild
/// to strong, as far as `effects` have them: what training hears in place of the clean piece.
/// Changes mono samples in place; not their speed.
/// Errors: as pass_lossy_codec; the samples are then as if without a codec.
[[nodiscard]] Expected<void> augment_for_genre(int rate,
                                               std::vector<float>& samples,
                                               Dice& dice,
                                               const SoundEffects& effects = {});

/// A drawn room and nothing else: 0.2 to 1.2 s to -60 dB, from mostly direct sound to mostly echo.
void enter_drawn_room(int rate, std::vector<float>& samples, Dice& dice);

}  // namespace raks::audio
