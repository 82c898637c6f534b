#pragma once

#include <span>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/band_palette.hpp"
#include "audio/music/styles/rhythm_style.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Adds a random band to a score: bass, chords and lead over a loop of four chords. The chord
/// changes on beat 1 of every bar, or every 2 or 4 bars, except that a tumbao plays the next chord
/// ahead of it. `bass` and `comping`: the choices to draw from; empty means anything that fits most
/// music. `chances`: how likely each player is.
void add_band(std::span<const BassLine> bass,
              std::span<const Comping> comping,
              Score& score,
              Dice& dice,
              const BandChances& chances = {});

}  // namespace raks::audio
