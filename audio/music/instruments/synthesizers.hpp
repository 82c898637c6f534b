#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/music/score/score.hpp"
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

/// One plucked note.
struct OudNote {
    double time = 0.0;      ///< s, >= 0
    double length = 0.2;    ///< s until it is damped
    double hertz = 220.0;   ///< any pitch, quarter tones included
    double strength = 1.0;  ///< (0, 1]
};

/// Notes plucked by the generator's oud (two strings a course, any pitch), an instrument that the
/// soundfonts lack. Mono at `rate`, peak 1, `samples` long. Notes that begin behind the end are
/// left out.
[[nodiscard]] std::vector<float> play_oud(std::span<const OudNote> notes,
                                          int rate,
                                          std::size_t samples);

}  // namespace raks::audio
