#pragma once

#include <vector>

#include "audio/music/score/performance.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Sound that nobody dances to, mono at `rate`: clapping of many hands, talk, or noise that swells.
[[nodiscard]] std::vector<float> noise_of_people(int rate, double seconds, Dice& dice);

/// Notes of some instruments at any time, without a pulse; no beats.
[[nodiscard]] Performance notes_without_pulse(double seconds, Dice& dice);

}  // namespace raks::audio
