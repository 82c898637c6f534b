#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/raks_train/genre_options.hpp"
#include "audio/evaluate/genre_folder.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/expected.hpp"
#include "training/genre/feature_shard.hpp"
#include "training/genre/written_corpus.hpp"

/// Computes the features that genre models are trained on, unit by unit; what an interrupted run
/// has finished is found in the cache by the next.
namespace raks::apps {

/// Cache-key suffix for the disabled augmentations, such as "-no-room"; empty when all are enabled.
[[nodiscard]] std::string without(const audio::SoundEffects& effects);

/// Identifies how features are computed: a hash of the beat network's weights and the feature
/// options.
[[nodiscard]] std::uint64_t feature_key(const audio::FeaturePlan& feature_plan,
                                        const audio::GenreFeatures& features);

/// Features of the files, one unit a file, in order: the recording, then its altered copies. Units
/// of other shares are empty. `damage`: the recordings after this damage, without copies. Progress
/// with the time left, and the cost, go to stderr.
[[nodiscard]] std::vector<audio::FeatureUnit> extract_recordings(
    const std::vector<audio::MusicFile>& files,
    const GenreOptions& options,
    const audio::FeaturePlan& feature_plan,
    audio::Damage damage = audio::Damage::none);

/// Written pieces whose features are computed and cached together.
struct WrittenChunk {
    std::string name;               ///< in the cache
    audio::WrittenCorpusPlan plan;  ///< for these pieces alone
};
/// Divides the pieces of a plan into chunks of 70. Threads, effects and edition are the options'.
[[nodiscard]] std::vector<WrittenChunk> chunks_of(const GenreOptions& options,
                                                  const audio::FeaturePlan& feature_plan,
                                                  const std::string& name,
                                                  audio::WrittenCorpusPlan plan);
/// Writes and plays the pieces of a chunk and computes their features, or finds these in the cache.
/// Errors: as write_corpus, load_pieces.
[[nodiscard]] Expected<std::vector<audio::PieceFeatures>> extract_chunk(const GenreOptions& options,
                                                                        const WrittenChunk& chunk);

}  // namespace raks::apps
