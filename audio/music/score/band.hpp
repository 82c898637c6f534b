#pragma once

#include <span>

#include "audio/music/score/score.hpp"
#include "audio/music/styles/band_palette.hpp"
#include "audio/music/styles/rhythm_style.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Lays a random band over a score: bass, chords and lead over a loop of chords that changes once
/// a bar (or every 2 or 4), on beat 1 except where the bass plays a tumbao. `bass` and `comping`:
/// what is drawn from; empty means anything that fits most music.
void add_band(std::span<const BassLine> bass,
              std::span<const Comping> comping,
              Score& score,
              Dice& dice,
              const BandChances& chances = {});

}  // namespace raks::audio
