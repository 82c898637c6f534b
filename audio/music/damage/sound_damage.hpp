#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Damage to music between the record and the microphone, for training and for tests of robustness.
/// Each function changes mono samples in place. Threads: any. Real-time: no.

/// Exponentially decaying reverberation: `seconds` to -60 dB; `wet` in [0, 1]: its share of the
/// result's amplitude.
void add_room(int rate, double seconds, double wet, std::vector<float>& samples, Dice& dice);
/// Adds white noise at this signal-to-noise ratio (dB) over the whole piece.
void add_white_noise(double ratio_db, std::vector<float>& samples, Dice& dice);
/// Low-pass of 36 dB an octave; no change above 0.45 of the rate.
void cut_above(int rate, double hertz, std::vector<float>& samples);
/// Gain in dB.
void change_gain(double db, std::vector<float>& samples);
/// Converts to `low_rate` and back by linear interpolation, without a filter: the aliasing of a
/// cheap recorder. No change when `low_rate` is not lower.
void change_rate(int rate, double low_rate, std::vector<float>& samples);
/// Changes speed and pitch together by linear interpolation: 1.08 is 8 % faster and shorter.
void change_speed(double ratio, std::vector<float>& samples);

/// The damages that evaluation measures, each of fixed strength.
enum class Damage : std::uint8_t {
    none,
    quieter_12_db,
    low_pass_4_khz,
    mp3_24_kbit,
    noise_10_db,
    room_600_ms
};
/// Their names in tables, in the order of Damage.
inline constexpr std::string_view kDamageNames[] = {
    "clean", "-12 dB", "low-pass 4 kHz", "MP3 24 kbit/s", "noise 10 dB", "room 0.6 s"};
/// Applies one of them; the same samples give the same result. Errors: as pass_lossy_codec.
[[nodiscard]] Expected<void> damage(Damage kind, int rate, std::vector<float>& samples);

}  // namespace raks::audio
