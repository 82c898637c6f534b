#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "models/recurrent_network.hpp"

/// The side file of a genre model: what is needed to add a genre later.
namespace raks::audio {

/// Default limit of a model's side file: bytes for each genre and for none of them.
inline constexpr std::size_t kMostSampleBytes = 2'000'000;

/// A bounded sample of what a model was trained on. When a genre is added, it suffices to train the
/// background model, the similarity model, the networks and the fusion again without the music of
/// the other genres.
struct GenreSamples {
    /// Identifies the features and the beat network that they were extracted with.
    std::string feature_key;
    std::vector<std::string> genres;  ///< names, in the model's order of classes
    /// The recurrent networks after training on written music and before tuning on recordings, 1 to
    /// GenreScorer::kMostNetworks; outputs: genres, none.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks;
    std::vector<PieceFeatures> pieces;  ///< stretches of up to 12 s
};

/// Draws stretches of up to 12 s until `bytes` a genre are used: groups in turn, recordings and
/// written music alternating. Pieces without frames are skipped. `genres`: the model's. The same
/// pieces and seed give the same sample.
[[nodiscard]] std::vector<PieceFeatures> sample_pieces(std::span<const PieceFeatures* const> pieces,
                                                       std::span<const std::string> genres,
                                                       std::size_t bytes,
                                                       std::uint64_t seed);

/// Path of a model's side file: "genres.json" has "genres.samples".
[[nodiscard]] std::filesystem::path samples_path(const std::filesystem::path& model);

/// Writes with 8 bits a number, each feature scaled between its extremes in the stretch (mel
/// magnitudes as logarithms). Errors: the file cannot be written.
[[nodiscard]] Expected<void> save_samples(const GenreSamples& samples,
                                          const std::filesystem::path& path);
/// Errors, one line with the file: none there, not made by this program, another version, cut short
/// or damaged, over 64 MiB.
[[nodiscard]] Expected<GenreSamples> load_samples(const std::filesystem::path& path);

}  // namespace raks::audio
