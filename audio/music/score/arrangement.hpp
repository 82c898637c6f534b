#pragma once

#include <cstdint>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/rhythm_style.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// A drum track of `beats` beats in this style: rows and variants drawn, some steps changed, ghost
/// notes, fills at the end of some 4-bar phrases.
[[nodiscard]] Score drum_score(const RhythmStyle& style, int beats, Dice& dice);

/// A drum track that follows no named style: 2 to 6 instruments with random rows of mild metrical
/// weight.
[[nodiscard]] Score free_drum_score(int beats, Dice& dice);

/// MIDI channel of the melody.
inline constexpr int kMelodyChannel = 3;

/// Scales of oriental melodies: the five maqamat that have semitones only, or also rast, bayati,
/// sikah, saba and huzam with their quarter tones.
enum class OrientalScales : std::uint8_t { semitones, quarter_tones };

/// A piece of `beats` beats in this style of the book: its drums, and a band and a melody drawn
/// from the palette of the style's dance.
[[nodiscard]] Score arrange(const StyleBook& book,
                            const RhythmStyle& style,
                            int beats,
                            Dice& dice,
                            OrientalScales scales = OrientalScales::semitones);

}  // namespace raks::audio
