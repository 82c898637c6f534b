#pragma once

#include <vector>

#include "audio/music/score/performance.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Takes the notes of some instruments and drums out of `performance` (each with chance `share`)
/// and plays them with sounds drawn for each. Four soundfonts are few; what is learnt from
/// thousands of sounds, though none is of a real instrument, has to hold for one more (domain
/// randomization: Tobin et al. 2017). Now and then the kick ducks what has a pitch, as in club
/// music. Mono, peak 0.7, at `rate`, performance.seconds long; empty if there is nothing to play.
[[nodiscard]] std::vector<float> play_synthesizers(double share,
                                                   int rate,
                                                   Performance& performance,
                                                   Dice& dice);

}  // namespace raks::audio
