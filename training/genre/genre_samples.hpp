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

namespace raks::audio {

/// What a model's side file may take of each genre, and of what is none of them.
inline constexpr std::size_t kMostSampleBytes = 2'000'000;

/// A bounded sample of what a model was learnt from: enough to fit its background model, what its
/// genres share, its networks and its fusion again when a genre is added, without the others'
/// music.
struct GenreSamples {
    std::string feature_key;  ///< names the features and the beat network that it was heard with
    std::vector<std::string> genres;  ///< of the model
    /// What the model's recurrent networks were before they heard recordings, 1 to
    /// GenreScorer::kMostNetworks; outputs: genres, none.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks;
    std::vector<PieceFeatures> pieces;  ///< stretches of up to 12 s
};

/// Stretches of these pieces, as many as `bytes` of each genre hold in a file: groups in turn,
/// recordings and written music by turns. Pieces without frames are passed over. `genres`: of
/// the model. Same pieces, same
/// seed: same sample.
[[nodiscard]] std::vector<PieceFeatures> sample_pieces(std::span<const PieceFeatures* const> pieces,
                                                       std::span<const std::string> genres,
                                                       std::size_t bytes,
                                                       std::uint64_t seed);

/// The side file of a model: "genres.json" has "genres.samples".
[[nodiscard]] std::filesystem::path samples_path(const std::filesystem::path& model);

/// Numbers are kept in 8 bits, each feature between its extremes in the stretch (mel magnitudes as
/// logarithms). Errors of reading, one line with the file: none there, none that this program made,
/// another version, cut short or damaged; at most 64 MiB.
[[nodiscard]] Expected<void> save_samples(const GenreSamples& samples,
                                          const std::filesystem::path& path);
[[nodiscard]] Expected<GenreSamples> load_samples(const std::filesystem::path& path);

}  // namespace raks::audio
