#pragma once

#include <cstdint>
#include <span>

#include "base/dice.hpp"

namespace raks::audio {

/// A synthesizer's sound for what has a pitch: oscillators (saw, pulse or a sine that another sine
/// modulates; Chowning 1973) through a low-pass that opens and closes.
struct DrawnTone {
    /// Wave form.
    enum class Oscillator : std::uint8_t { saw, pulse, modulated };
    /// Of all voices.
    Oscillator oscillator = Oscillator::saw;
    int voices = 1;            ///< detuned against each other
    double detune = 0.0;       ///< of the outermost voices, as a part of the frequency
    double pulse_width = 0.5;  ///< (0, 1)
    double ratio = 1.0;        ///< the modulating sine's frequency to the other's
    double index = 1.0;        ///< radians of modulation at the attack
    double breath = 0.0;       ///< noise beside the oscillators
    double attack = 0.005;     ///< s
    double decay = 0.3;        ///< s until 1/e, towards `sustain`
    double sustain = 0.0;      ///< [0, 1]
    double release = 0.05;     ///< s until 1/e
    double cutoff = 8.0;       ///< of the low-pass, in harmonics, when closed
    double opening = 8.0;      ///< harmonics more at the attack
    double resonance = 0.8;    ///< Q
    double vibrato = 0.0;      ///< as a part of the frequency
    double drive = 1.0;        ///< into a soft limit
    double level = 1.0;        ///< in the mix
};

/// Draws a sound of the kind that belongs to an instrument of General MIDI (`program`, 0-127): what
/// is struck dies away, what is bowed or blown stays, pads swell.
[[nodiscard]] DrawnTone draw_tone(int program, Dice& dice);

/// One note to synthesize.
struct ToneNote {
    double time = 0.0;      ///< s
    double length = 0.2;    ///< s
    double hertz = 220.0;   ///< fundamental
    double strength = 1.0;  ///< (0, 1]
};

/// Adds a note to `samples` (mono, `rate` a second, from time 0); what does not fit is cut off.
void add_note(const DrawnTone& tone, const ToneNote& note, int rate, std::span<float> samples);

}  // namespace raks::audio
