#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What may happen to music between the record and the microphone: to learn from and to be tested
/// with. Each changes mono samples in place.

/// An exponentially decaying room: `seconds` to -60 dB, `wet` in [0, 1] of the result's amplitude.
void add_room(int rate, double seconds, double wet, std::vector<float>& samples, Dice& dice);
/// White noise at this signal-to-noise ratio over the whole piece.
void add_white_noise(double ratio_db, std::vector<float>& samples, Dice& dice);
/// Low-pass of 36 dB an octave.
void cut_above(int rate, double hertz, std::vector<float>& samples);
void change_gain(double db, std::vector<float>& samples);
/// What a sound card or a cheap recorder at a lower rate leaves: brought to `low_rate` and back by
/// straight lines, aliases and all.
void change_rate(int rate, double low_rate, std::vector<float>& samples);
/// Another speed and pitch: 1.08 is 8 % faster. Linear interpolation.
void change_speed(double ratio, std::vector<float>& samples);

/// What the robustness of a model is tested with.
enum class Damage : std::uint8_t {
    none,
    quieter_12_db,
    low_pass_4_khz,
    mp3_24_kbit,
    noise_10_db,
    room_600_ms
};
inline constexpr std::string_view kDamageNames[] = {
    "clean", "-12 dB", "low-pass 4 kHz", "MP3 24 kbit/s", "noise 10 dB", "room 0.6 s"};
/// Errors: as pass_lossy_codec.
[[nodiscard]] Expected<void> damage(Damage kind, int rate, std::vector<float>& samples);

}  // namespace raks::audio
