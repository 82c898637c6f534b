#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Augmentations of music on its way to a microphone. Each can be switched off by its name.
enum class SoundEffect : std::uint8_t {
    voice,       ///< somebody speaks over it
    equalizer,   ///< up to two bells
    overdrive,   ///< soft clipping
    band,        ///< low- and high-pass: small loudspeakers and microphones
    noise,       ///< white to brown
    gain,        ///< down to -30 dB
    room,        ///< reverberation
    speed,       ///< tempo and pitch together
    resampling,  ///< to a lower rate and back
    codec,       ///< MP3 or Opus
    players      ///< a band of several soundfonts, each with a sound of its own
};
/// Names of the effects in the order of SoundEffect, as users type them.
inline constexpr std::string_view kSoundEffectNames[] = {"voice",
                                                         "equalizer",
                                                         "overdrive",
                                                         "band",
                                                         "noise",
                                                         "gain",
                                                         "room",
                                                         "speed",
                                                         "resampling",
                                                         "codec",
                                                         "players"};

/// The enabled effects; all are enabled at first.
class SoundEffects {
 public:
    /// Whether an effect is enabled.
    [[nodiscard]] bool has(SoundEffect effect) const { return kept_[index(effect)]; }
    /// Disables an effect.
    void leave_out(SoundEffect effect) { kept_.reset(index(effect)); }
    /// Whether both enable the same effects.
    friend bool operator==(const SoundEffects&, const SoundEffects&) = default;

 private:
    static std::size_t index(SoundEffect effect) { return static_cast<std::size_t>(effect); }
    std::bitset<std::size(kSoundEffectNames)> kept_{~0ULL};
};

/// Augments music at random with the enabled ones of: a voice over it, bells of an equalizer,
/// overdrive, low- and high-pass, noise, gain. Changes `samples` (mono) in place. The same dice
/// give the same result. Threads: any. Real-time: no.
void augment_sound(int sample_rate,
                   std::vector<float>& samples,
                   Dice& dice,
                   const SoundEffects& effects = {});

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
