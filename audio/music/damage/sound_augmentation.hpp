#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/dice.hpp"

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

}  // namespace raks::audio
