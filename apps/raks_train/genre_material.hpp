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

/// Training material: the files, and the features of all pieces, written ones too.
struct GenreMaterial {
    std::vector<audio::MusicFile> files;       ///< the recordings
    std::string written_with;                  ///< credit of the written music, or empty
    std::vector<audio::PieceFeatures> pieces;  ///< recordings first, then written pieces
};

/// Computes the features of the folder's music, with altered copies, and of the written music asked
/// for; or merges the shards that are named. Files that cannot be read are named on stderr, counted
/// and left out. Errors: no music at all; two genres with the same files; with --strict the first
/// file that cannot be read; of shards: as merge_shards.
[[nodiscard]] Expected<GenreMaterial> gather(const GenreOptions& options,
                                             const audio::FeaturePlan& feature_plan);

/// Computes the features of this machine's share and writes them to a file, with `command`. Errors:
/// as gather; the file cannot be written.
[[nodiscard]] Expected<void> write_shard(const GenreOptions& options,
                                         const audio::FeaturePlan& feature_plan,
                                         const std::string& command);

/// Features of written music, chunk by chunk through the cache. Errors: as extract_chunk.
[[nodiscard]] Expected<std::vector<audio::PieceFeatures>> written(
    const GenreOptions& options,
    const audio::FeaturePlan& feature_plan,
    const std::string& name,
    const audio::WrittenCorpusPlan& plan);

}  // namespace raks::apps
