#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "audio/genre/genre_words.hpp"
#include "audio/genre/tag_evidence.hpp"
#include "audio/io/audio_tags.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {

/// Reads the table of what words in tags say: config/genres.toml as installed, and over it
/// $XDG_CONFIG_HOME/raks/genres.toml where that is there. A row may say a dance of `dances` or a
/// genre of `model`. Errors: a file that is missing or bad, with file and line. Threads: main.
[[nodiscard]] Expected<std::shared_ptr<const audio::GenreWords>> load_told_genres(
    const DanceList& dances, const audio::GenreModel* model);

/// ln of the odds by which what a person said of other songs by this artist in this folder speaks
/// for a song: somewhat more than a genre in its tags (kGenreTagStrength, where it was measured).
/// What is heard can still be clearer, and another metre forbids it.
inline constexpr float kAlbumStrength = 2.0F;

/// What is known of a file's dance before it is heard. What the person said of this very song is
/// certain; else what was said of the artist's songs in its folder counts, the songs sharing
/// kAlbumStrength; else what the tags say. Nothing where `models` has neither corrections nor a
/// table. `file`: empty where the music comes through a pipe. Threads: any.
[[nodiscard]] audio::TagEvidence told_by(const AnalyzerModels& models,
                                         const audio::AudioTags& tags,
                                         const std::filesystem::path& file);

/// The same models for the analyzer of one file: they know what is said of it, and the tempo in its
/// tags where the tracker can find such a tempo at all. Threads: any.
[[nodiscard]] AnalyzerModels told(AnalyzerModels models,
                                  const audio::AudioTags& tags,
                                  const std::filesystem::path& file);

/// "salsa", as people are told; of what is none of the dances "none of the dances"; empty: nothing.
[[nodiscard]] std::string_view told_name(const audio::TagEvidence& evidence);
/// "as you said", or "as the file says".
[[nodiscard]] std::string_view teller_of(const audio::TagEvidence& evidence);

}  // namespace raks::engine
