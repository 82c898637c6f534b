#pragma once

#include "audio/music_analyzer.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// An analyzer for samples of this rate, with the beat network that comes with Raks
/// (models/trained/beats.json).
/// Errors: a rate that is not supported, a network file that is missing or bad.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate, audio::BeatMethod method = audio::BeatMethod::pointer);

}  // namespace raks::engine
