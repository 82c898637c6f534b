#pragma once

#include <span>
#include <vector>

#include "audio/music/score/performance.hpp"
#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Makes of a score what machines play: drum machines and synthesizers, exactly in time; echoes in
/// time with the beat; parts that come and go with the phrases of 2 or 4 bars, each drawn.
void give_to_machines(Score& score, Dice& dice);

/// What a studio does to electronic music after it is played, each drawn: a compressor that the
/// bass drum drives ("pumping"), a low-pass that opens and closes over seconds. Changes `samples`
/// (mono).
void produce(const Performance& played, int sample_rate, std::vector<float>& samples, Dice& dice);

/// The level of what a compressor lets through that dips by `depth` of it after each of `drums`
/// (seconds, ascending) and is back after `release` seconds. Changes `samples`.
void pump(std::span<const double> drums,
          double depth,
          double release,
          int sample_rate,
          std::vector<float>& samples);

}  // namespace raks::audio
