#pragma once

#include <vector>

#include "audio/music/damage/sound_augmentation.hpp"
#include "base/dice.hpp"
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

/// Which altered copy of a recording is heard in a room. Echoes take one dance for another more
/// than all else does, and what happens at random seldom has much of them.
inline constexpr int kRoomEvery = 3;

/// Makes altered copy `copy`, from 1, of a recording: up to 8 % slower or faster, then augmented,
/// or, every third, in a drawn room and nothing else: 0.2 to 1.2 s to -60 dB, from mostly direct
/// sound to mostly echo.
/// Errors: as augment_for_genre.
[[nodiscard]] Expected<void> alter_recording(
    int rate, int copy, std::vector<float>& samples, Dice& dice, const SoundEffects& effects = {});

}  // namespace raks::audio
