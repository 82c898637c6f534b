#pragma once

#include <vector>

#include "audio/math/dice.hpp"

namespace raks::audio {

/// Room, band limit, noise, and what the beat tracker's training does (voice, equalizer, overdrive,
/// gain), at random, mild to strong: what training hears in place of the clean piece. Changes mono
/// samples in place.
void augment_for_genre(int rate, std::vector<float>& samples, Dice& dice);

}  // namespace raks::audio
