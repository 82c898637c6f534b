#pragma once

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// A piece for a keyboard alone in the manner of the 18th and 19th centuries, of `beats` beats: a
/// melody of drawn rhythm, and under it a texture: broken chords, Alberti bass, waltz bass, steady
/// figuration, two voices, chords. Metres of 2, 3, 4 and (in dotted beats) 6/8.
[[nodiscard]] Score keyboard_score(int beats, Dice& dice);

}  // namespace raks::audio
