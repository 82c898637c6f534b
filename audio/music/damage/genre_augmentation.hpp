#pragma once

#include <vector>

#include "audio/music/damage/sound_augmentation.hpp"
#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Augments a piece for genre training, at random and from mild to strong, with those effects that
/// `effects` has: room, band limit, noise, another sampling rate, a lossy codec (MP3 or Opus of 16
/// to 96 kbit/s), and those of augment_sound() (voice, equalizer, overdrive, gain). Changes mono
/// samples in place, not their speed. Threads: any. Real-time: no.
/// Errors: as pass_lossy_codec; the samples are then as if without a codec.
[[nodiscard]] Expected<void> augment_for_genre(int rate,
                                               std::vector<float>& samples,
                                               Dice& dice,
                                               const SoundEffects& effects = {});

/// Every how many altered copies of a recording one is in a room and nothing else: reverberation
/// confuses dances more than other damage, and random augmentation seldom has much of it.
inline constexpr int kRoomEvery = 3;

/// Makes altered copy `copy`, counted from 1, of a recording: up to 8 % slower or faster, then
/// augmented, or, every kRoomEvery-th, in a random room and nothing else: 0.2 to 1.2 s to -60 dB,
/// from mostly direct sound to mostly reverberation.
/// Errors: as augment_for_genre.
[[nodiscard]] Expected<void> alter_recording(
    int rate, int copy, std::vector<float>& samples, Dice& dice, const SoundEffects& effects = {});

}  // namespace raks::audio
