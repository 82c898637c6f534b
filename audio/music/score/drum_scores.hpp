#pragma once

#include "audio/music/score/score.hpp"
#include "audio/music/styles/rhythm_style.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// A drum track of `beats` beats in this style: rows and variants drawn, some steps changed, ghost
/// notes, fills at the end of some 4-bar phrases.
[[nodiscard]] Score drum_score(const RhythmStyle& style, int beats, Dice& dice);

/// A drum track that follows no named style: 2 to 6 instruments with random rows of mild metrical
/// weight.
[[nodiscard]] Score free_drum_score(int beats, Dice& dice);

}  // namespace raks::audio
