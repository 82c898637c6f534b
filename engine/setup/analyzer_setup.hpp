#pragma once

#include <filesystem>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/music_analyzer.hpp"
#include "base/dance_list.hpp"
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

/// What analyzers share: read once, used by any number of them.
struct AnalyzerModels {
    std::shared_ptr<const audio::BeatNetwork> beats;
    std::shared_ptr<const audio::GenreModel> genres;  ///< null: the genre stays unknown
    std::shared_ptr<const DanceList> dances;          ///< that MusicState::genre numbers
};

/// Those that come with Raks (models/trained/beats.json, genres.json).
/// Errors: a file that is missing or bad. Threads: workers.
[[nodiscard]] Expected<AnalyzerModels> load_analyzer_models(
    std::shared_ptr<const DanceList> dances);

/// An analyzer for samples of this rate. Errors: a rate that is not supported.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate,
    const AnalyzerModels& models,
    audio::BeatMethod method = audio::BeatMethod::pointer);

}  // namespace raks::engine
