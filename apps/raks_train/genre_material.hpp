#pragma once

#include <string>
#include <vector>

#include "apps/raks_train/genre_options.hpp"
#include "audio/evaluate/genre_folder.hpp"
#include "base/expected.hpp"
#include "training/genre/feature_shard.hpp"
#include "training/genre/genre_trainer.hpp"
#include "training/genre/written_corpus.hpp"

namespace raks::apps {

/// Music to learn from: the files, and all of it (written music, too) as heard.
struct GenreMaterial {
    std::vector<audio::MusicFile> files;
    std::string written_with;  ///< credit of the written music, or empty
    std::vector<audio::PieceFeatures> pieces;
};

/// Reads and hears the folder's music, clean and damaged, and writes what is asked for; or merges
/// the shards that are named. Files that cannot be read are named on stderr, counted and left out.
/// Errors: no music at all, two genres with the same files, with --strict the first file that
/// cannot be read; of shards: as merge_shards.
[[nodiscard]] Expected<GenreMaterial> gather(const GenreOptions& options,
                                             const audio::FeaturePlan& feature_plan);

/// Hears this machine's share of all that into a file. `command`: is kept in it.
/// Errors: as gather; the file cannot be written.
[[nodiscard]] Expected<void> write_shard(const GenreOptions& options,
                                         const audio::FeaturePlan& feature_plan,
                                         const std::string& command);

/// Written music, chunk by chunk: what a stopped run has finished is found again by the next.
[[nodiscard]] Expected<std::vector<audio::PieceFeatures>> written(
    const GenreOptions& options,
    const audio::FeaturePlan& feature_plan,
    const std::string& name,
    const audio::WrittenCorpusPlan& plan);

}  // namespace raks::apps
