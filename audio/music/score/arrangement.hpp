#pragma once

#include <cstdint>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/genre_styles.hpp"
#include "base/dice.hpp"

namespace raks::audio {

inline constexpr int kMelodyChannel = 3;

/// Which scales oriental melodies have: the five maqamat of semitones alone, or also rast, bayati,
/// sikah, saba and huzam with their quarter tones.
enum class OrientalScales : std::uint8_t { semitones, quarter_tones };

/// A piece of `beats` beats in this style: its drums, a band of the genre's instruments, and a
/// melody of the genre's manner: brass riffs ahead of the beat (salsa), one voice in a maqam that
/// others follow a little late, over a drone (belly), riffs of sixteenths (house), fifths on an
/// electric guitar (rock), long notes on the beat (waltz).
[[nodiscard]] Score arrange(const GenreStyle& style,
                            int beats,
                            Dice& dice,
                            OrientalScales scales = OrientalScales::semitones);

}  // namespace raks::audio
