#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "models/gaussian_hmm.hpp"

/// Training of the HMMs of a genre model.
namespace raks::audio {

/// How the HMMs on MFCC features are trained.
struct MfccTrainingPlan {
    int states = 2;      ///< of an ergodic HMM; 1: a Gaussian mixture
    int mixtures = 8;    ///< Gaussians a state, diagonal
    int frames = 8'000;  ///< at most, for each model; drawn in stretches, every piece equally often
    int iterations = 3;  ///< Baum-Welch rounds after each split of the mixtures
    int similarity_rounds = 1;  ///< of inter-genre similarity; 0: no similarity model
    /// Share of the frames where there are recordings and written music.
    double recorded_share = 0.5;
    std::uint64_t seed = 1;  ///< of the draws
    int threads = 2;         ///< of the E-step; any number gives the same bits
};

/// The trained HMMs.
struct MfccModels {
    std::vector<models::GaussianHmm> genres;  ///< one a genre
    models::GaussianHmm background;           ///< of all music
    /// Of frames that genres confuse; none: not trained, or too few such frames.
    std::optional<models::GaussianHmm> similarity;
};

/// Trains one HMM a genre, one of all pieces, and the similarity model: the model of the frames
/// whose own genre's HMM does not score highest. Each round trains it on those frames and the
/// genres, for the next round, on the rest (Bagci, Erzin 2007). `classes[i]`: class of pieces[i];
/// those beyond the genres count for the background only.
/// Errors: a genre with fewer frames than its model has parameters (names it).
[[nodiscard]] Expected<MfccModels> train_mfcc(std::span<const PieceFeatures* const> pieces,
                                              std::span<const std::size_t> classes,
                                              std::span<const std::string> genres,
                                              const GenreFeatures& features,
                                              const MfccTrainingPlan& plan);

}  // namespace raks::audio
