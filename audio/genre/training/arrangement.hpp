#pragma once

#include "audio/beat/training/score.hpp"
#include "audio/genre/training/genre_styles.hpp"
#include "audio/math/dice.hpp"

namespace raks::audio {

/// A piece of `beats` beats in this style: its drums, a band of the genre's instruments, and a
/// melody of the genre's manner: brass riffs ahead of the beat (salsa), one voice in a maqam that
/// others follow a little late, over a drone (belly), riffs of sixteenths (house), fifths on an
/// electric guitar (rock), long notes on the beat (waltz).
[[nodiscard]] Score arrange(const GenreStyle& style, int beats, Dice& dice);

}  // namespace raks::audio
