#pragma once

#include <filesystem>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/music_analyzer.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Reads the beat network that comes with Raks, or one of `path`.
/// Errors: a file that is missing or bad.
[[nodiscard]] Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
    const std::filesystem::path& path = {});

/// Reads the genre model that comes with Raks (models/trained/genres.json), or one of `path`.
/// Errors: a file that is missing or bad.
[[nodiscard]] Expected<std::shared_ptr<const audio::GenreModel>> load_genre_model(
    const std::filesystem::path& path = {});

/// An analyzer for samples of this rate, with the beat network and the genre model that come with
/// Raks (models/trained/beats.json, genres.json).
/// Errors: a rate that is not supported, a network file that is missing or bad.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate, audio::BeatMethod method = audio::BeatMethod::pointer);
/// The same with a network of the caller's, for beats alone.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate, audio::BeatMethod method, std::shared_ptr<const audio::BeatNetwork> network);

}  // namespace raks::engine
