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

/// Hearing what genre models are learnt from, unit by unit; what a stopped run has finished is
/// found again in the cache.
namespace raks::apps {

/// What tells music altered in one way from music altered in another: nothing if all may happen.
[[nodiscard]] std::string without(const audio::SoundEffects& effects);

/// Name of a way of hearing: the beat network and the features.
[[nodiscard]] std::uint64_t feature_key(const audio::FeaturePlan& feature_plan,
                                        const audio::GenreFeatures& features);

/// One unit a file, in order: the recording, then its altered copies; those of other shares are
/// empty. `damage`: the recordings after it, without copies. Progress with the time left, and what
/// it cost, goes to stderr.
[[nodiscard]] std::vector<audio::FeatureUnit> extract_recordings(
    const std::vector<audio::MusicFile>& files,
    const GenreOptions& options,
    const audio::FeaturePlan& feature_plan,
    audio::Damage damage = audio::Damage::none);

/// Written pieces that are made in one go.
struct WrittenChunk {
    std::string name;
    audio::WrittenCorpusPlan plan;
};
/// The pieces of a plan, 70 a chunk. The number of threads, effects and edition are the options'.
[[nodiscard]] std::vector<WrittenChunk> chunks_of(const GenreOptions& options,
                                                  const audio::FeaturePlan& feature_plan,
                                                  const std::string& name,
                                                  audio::WrittenCorpusPlan plan);
/// Written, played and heard, or found in the cache. Errors: as write_corpus, load_pieces.
[[nodiscard]] Expected<std::vector<audio::PieceFeatures>> extract_chunk(const GenreOptions& options,
                                                                        const WrittenChunk& chunk);

}  // namespace raks::apps
