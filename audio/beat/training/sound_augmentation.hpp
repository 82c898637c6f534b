#pragma once

#include <vector>

#include "audio/math/dice.hpp"

namespace raks::audio {

/// What happens to music before a microphone hears it, drawn at random: a voice over it, bells of
/// an equalizer, overdrive, low- and high-pass, noise, gain. Changes `samples` (mono).
void augment_sound(int sample_rate, std::vector<float>& samples, Dice& dice);

}  // namespace raks::audio
