#pragma once

#include <vector>

#include "audio/music/score/performance.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Sound that nobody dances to, mono at `rate`, `seconds` long: applause, talk, or noise that
/// swells.
[[nodiscard]] std::vector<float> noise_of_people(int rate, double seconds, Dice& dice);

/// Notes of drums or of one instrument at random times, without a pulse; `beats` is empty.
[[nodiscard]] Performance notes_without_pulse(double seconds, Dice& dice);

}  // namespace raks::audio
