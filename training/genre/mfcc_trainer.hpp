#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "models/gaussian_hmm.hpp"

namespace raks::audio {

struct MfccTrainingPlan {
    int states = 2;               ///< ergodic; 1: a Gaussian mixture
    int mixtures = 8;             ///< Gaussians a state
    int frames = 8'000;           ///< at most, of a model; drawn in stretches, pieces alike
    int iterations = 3;           ///< of Baum-Welch after each growth
    int similarity_rounds = 1;    ///< of inter-genre similarity; 0: no such model
    double recorded_share = 0.5;  ///< of the frames, where there are recordings and written music
    std::uint64_t seed = 1;
    int threads = 2;
};

struct MfccModels {
    std::vector<models::GaussianHmm> genres;
    models::GaussianHmm background;
    std::optional<models::GaussianHmm> similarity;
};

/// One HMM a genre, one of all pieces, and the model of the frames that the genres confuse: those
/// whose own genre's model does not win. Each round trains it on them and the genres on the rest.
/// (Bagci, Erzin 2007.) `classes[i]`: genre number of pieces[i]; beyond the genres: only for the
/// background.
/// Errors: a genre with fewer frames than its model has parameters (names it).
[[nodiscard]] Expected<MfccModels> train_mfcc(std::span<const PieceFeatures* const> pieces,
                                              std::span<const std::size_t> classes,
                                              std::span<const std::string> genres,
                                              const GenreFeatures& features,
                                              const MfccTrainingPlan& plan);

}  // namespace raks::audio
