#pragma once

#include <filesystem>
#include <memory>

#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Reads a beat network: the shipped one (models/trained/beats.json), or the file at `path`.
/// Errors: a file that is missing or bad. Threads: workers.
[[nodiscard]] Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
    const std::filesystem::path& path = {});

/// Reads a genre model: the shipped one (models/trained/genres.json), or the file at `path`.
/// Errors: a file that is missing or bad. Threads: workers.
[[nodiscard]] Expected<std::shared_ptr<const audio::GenreModel>> load_genre_model(
    const std::filesystem::path& path = {});

/// The models that analyzers share: read once, immutable, used by any number of analyzers.
struct AnalyzerModels {
    /// Of the beat tracker; null: its method must not need one.
    std::shared_ptr<const audio::BeatNetwork> beats;
    std::shared_ptr<const audio::GenreModel> genres;  ///< null: the genre stays unknown
    std::shared_ptr<const DanceList> dances;          ///< the list that MusicState::genre indexes
};

/// Reads the shipped models. `dances`: the list that the genres are numbered by. Errors: a file
/// that is missing or bad. Threads: workers.
[[nodiscard]] Expected<AnalyzerModels> load_analyzer_models(
    std::shared_ptr<const DanceList> dances);

/// An analyzer for mono samples of this rate. Errors: a rate that is not supported.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate,
    const AnalyzerModels& models,
    audio::BeatMethod method = audio::BeatMethod::pointer);

/// The analyzer of a whole song, for mono samples of this rate. Errors: as make_analyzer.
[[nodiscard]] Expected<audio::SongAnalyzer> make_song_analyzer(SampleRate rate,
                                                               const AnalyzerModels& models);

}  // namespace raks::engine
