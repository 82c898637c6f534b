#pragma once

#include <memory>

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

/// What a file's tags say of its dance; nothing where `models` has no table.
[[nodiscard]] audio::TagEvidence told_by(const AnalyzerModels& models,
                                         const audio::AudioTags& tags);

/// The same models for the analyzer of one file: they know what its tags say. Threads: any.
[[nodiscard]] AnalyzerModels told(AnalyzerModels models, const audio::AudioTags& tags);

/// "salsa", as people are told; of what is none of the dances "none of the dances"; empty: nothing.
[[nodiscard]] std::string_view told_name(const audio::TagEvidence& evidence);

}  // namespace raks::engine
