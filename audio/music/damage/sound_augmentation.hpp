#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/dice.hpp"

namespace raks::audio {

/// What may happen to music before a microphone hears it.
enum class SoundEffect : std::uint8_t {
    voice,
    equalizer,
    overdrive,
    band,  ///< low- and high-pass: small loudspeakers and microphones
    noise,
    gain,
    room,
    speed,
    resampling,
    codec,
    players  ///< of several soundfonts, each with a sound of its own
};
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

/// Those that may happen: at first all.
class SoundEffects {
 public:
    [[nodiscard]] bool has(SoundEffect effect) const { return kept_[index(effect)]; }
    void leave_out(SoundEffect effect) { kept_.reset(index(effect)); }
    friend bool operator==(const SoundEffects&, const SoundEffects&) = default;

 private:
    static std::size_t index(SoundEffect effect) { return static_cast<std::size_t>(effect); }
    std::bitset<std::size(kSoundEffectNames)> kept_{~0ULL};
};

/// What happens to music before a microphone hears it, drawn at random: a voice over it, bells of
/// an equalizer, overdrive, low- and high-pass, noise, gain, as far as `effects` have them. Changes
/// `samples` (mono).
void augment_sound(int sample_rate,
                   std::vector<float>& samples,
                   Dice& dice,
                   const SoundEffects& effects = {});

}  // namespace raks::audio
