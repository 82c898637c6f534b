#pragma once

#include <vector>

#include "audio/music/score/performance.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Takes the notes of some instruments and drums out of `performance` (each instrument with chance
/// `share`) and plays them with sounds drawn for each. A few soundfonts are little variety; a model
/// trained on thousands of drawn sounds, none of them a real instrument's, should hold for one more
/// (domain randomization: Tobin et al. 2017). In some pieces the kick ducks what has a pitch, as in
/// club music. Mono, peak 0.7, at `rate`, performance.seconds long; empty if there is nothing to
/// play.
[[nodiscard]] std::vector<float> play_synthesizers(double share,
                                                   int rate,
                                                   Performance& performance,
                                                   Dice& dice);

}  // namespace raks::audio
