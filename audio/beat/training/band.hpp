#pragma once

#include <span>

#include "audio/beat/training/score.hpp"
#include "audio/beat/training/styles/rhythm_styles.hpp"
#include "audio/math/dice.hpp"

namespace raks::audio {

/// How likely each player of a band is there.
struct BandChances {
    double bass = 0.85;
    double chords = 0.8;
    double lead = 0.55;
};

/// Lays a random band over a score: bass, chords and lead over a loop of chords that changes once
/// a bar (or every 2 or 4), on beat 1 except in Latin styles. `bass` and `comping`: what is drawn
/// from; empty means anything that fits most music.
void add_band(std::span<const BassLine> bass,
              std::span<const Comping> comping,
              Score& score,
              Dice& dice,
              const BandChances& chances = {});

}  // namespace raks::audio
