#pragma once

#include <cstdint>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/dice.hpp"

namespace raks::audio {

inline constexpr int kMelodyChannel = 3;

/// Which scales oriental melodies have: the five maqamat of semitones alone, or also rast, bayati,
/// sikah, saba and huzam with their quarter tones.
enum class OrientalScales : std::uint8_t { semitones, quarter_tones };

/// A piece of `beats` beats in this style of the book: its drums, and a band of the instruments and
/// a melody in the manner that the palette of its dance has.
[[nodiscard]] Score arrange(const StyleBook& book,
                            const RhythmStyle& style,
                            int beats,
                            Dice& dice,
                            OrientalScales scales = OrientalScales::semitones);

}  // namespace raks::audio
