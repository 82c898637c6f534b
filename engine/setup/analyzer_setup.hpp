#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "audio/beat/network/beat_network.hpp"
#include "audio/genre/genre_model.hpp"
#include "audio/genre/genre_words.hpp"
#include "audio/genre/tag_source.hpp"
#include "audio/genre/tagger_network.hpp"
#include "audio/music_analyzer.hpp"
#include "audio/song/song_plan.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"

namespace raks::engine {

class KeptCorrections;  // engine/setup/dance_corrections.hpp

/// Whether BeatNet is heard beside a beat network (audio/beat/network/beatnet.hpp).
enum class BeatNetUse { off, on };

/// Reads a beat network, the shipped one (models/trained/beats.json) or the file at `path`, and
/// BeatNet's shipped weights to be heard beside it. Errors: a file that is missing or bad. Threads:
/// workers.
[[nodiscard]] Expected<std::shared_ptr<const audio::BeatNetwork>> load_beat_network(
    const std::filesystem::path& path = {}, BeatNetUse beatnet = BeatNetUse::on);

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
    /// What words in a file's tags say (engine/setup/told_genre.hpp); null: tags say nothing.
    std::shared_ptr<const audio::GenreWords> words = nullptr;
    /// What the person said of songs; null: nothing, as where music is measured.
    std::shared_ptr<KeptCorrections> corrections = nullptr;
    /// Of one file, what the person or its tags say: AnalyzerConfig::genre_prior.
    GenreLogProbabilities genre_prior{};
    double told_bpm = 0.0;  ///< of one file, as its tags say: AnalyzerConfig::told_bpm
    std::shared_ptr<const audio::TaggerNetwork> tagger = {};  ///< null: nothing is tagged
    /// For the person, to be said once: why there is no tagger although one was asked for. Empty:
    /// nothing.
    std::string tagger_note = {};
};

/// Whether music is tagged (audio/genre/music_tagger.hpp).
enum class TaggerUse { off, on };
/// In the order of TaggerUse.
inline constexpr std::array<std::string_view, 2> kTaggerUseNames = {"off", "on"};
/// Whether what a file says of its dance counts.
enum class FileTags { read, ignored };

/// What helps to tell a dance, beside the parts of the genre model.
struct GenreAids {
    TaggerUse tagger = TaggerUse::on;
    FileTags tags = FileTags::read;  ///< of files
};

/// Reads the shipped models, and of what helps them what is asked for. `dances`: the list that the
/// genres are numbered by. Errors: a file that is missing or bad; but without the tagger's weights
/// the program hears all the same, and AnalyzerModels::tagger_note says so. Threads: workers.
[[nodiscard]] Expected<AnalyzerModels> load_analyzer_models(std::shared_ptr<const DanceList> dances,
                                                            const GenreAids& aids);

/// A tagger that works where the analyzer does; null where there are no weights.
[[nodiscard]] std::shared_ptr<audio::TagSource> make_tagger(const AnalyzerModels& models);

/// An analyzer for mono samples of this rate. `tags`: takes its sound, see AnalyzerConfig; null:
/// nothing is tagged. Errors: a rate that is not supported.
[[nodiscard]] Expected<audio::MusicAnalyzer> make_analyzer(
    SampleRate rate,
    const AnalyzerModels& models,
    audio::BeatMethod method = audio::BeatMethod::pointer,
    std::shared_ptr<audio::TagSource> tags = nullptr);

/// The analyzer of a whole song, for mono samples of this rate. Errors: as make_analyzer.
[[nodiscard]] Expected<audio::SongAnalyzer> make_song_analyzer(
    SampleRate rate,
    const AnalyzerModels& models,
    std::shared_ptr<audio::TagSource> tags = nullptr);

}  // namespace raks::engine
