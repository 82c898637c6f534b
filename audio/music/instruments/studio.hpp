#pragma once

#include <span>
#include <vector>

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Turns a score into one for drum machines and synthesizers: exactly in time, with echoes in time
/// with the beat, and parts that come and go with phrases of 2 or 4 bars; each of these is drawn.
void give_to_machines(Score& score, Dice& dice);

/// Effects of a studio on electronic music that is played already, each drawn: a compressor that
/// the bass drum drives ("pumping"), a low-pass that opens and closes over seconds. Changes
/// `samples` (mono); `played` tells where the bass drum is.
void produce(const Performance& played, int sample_rate, std::vector<float>& samples, Dice& dice);

/// Pumping: the level dips by the share `depth` ([0, 1]) after each of `drums` (seconds, ascending)
/// and is back after `release` seconds. Changes `samples`.
void pump(std::span<const double> drums,
          double depth,
          double release,
          int sample_rate,
          std::vector<float>& samples);

}  // namespace raks::audio
