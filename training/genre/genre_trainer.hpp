#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_fusion.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "training/genre/mfcc_trainer.hpp"
#include "training/genre/network_trainer.hpp"
#include "training/genre/pattern_trainer.hpp"

/// Trains genre models of all kinds of evidence, and cross-validates them.
namespace raks::audio {

/// How every part of a genre model is trained.
struct GenreTrainingPlan {
    GenreFeatures features;                          ///< which MFCC features the HMMs use
    MfccTrainingPlan mfcc;                           ///< the HMMs
    PatternTrainingPlan rhythm = rhythm_training();  ///< pattern network on rhythm features
    PatternTrainingPlan sound = sound_training();    ///< pattern network on sound features
    NetworkTrainingPlan network;                     ///< the recurrent networks
    /// Results of train_on_written on all written pieces, one for each of network.networks, so that
    /// no fold trains them again. Empty: each model trains them on its own pieces.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks;
    int folds = 3;  ///< of cross_validate, >= 2
};

/// Genres that occur among the pieces: those in `order` first, then the others by name.
[[nodiscard]] std::vector<std::string> genres_of(std::span<const PieceFeatures> pieces,
                                                 std::span<const std::string_view> order);

/// Trains a model on all these pieces; its fusion stays the default until calibrate().
/// Errors: no genre, or one with too little sound for its model. Threads: workers. Real-time: no.
[[nodiscard]] Expected<GenreModel> train_genres(std::span<const PieceFeatures* const> pieces,
                                                std::span<const std::string> genres,
                                                const GenreTrainingPlan& plan);

/// Cross-validation by group (artist): groups are dealt to folds genre by genre, and each fold's
/// pieces are scored by a model trained on the other folds. Scored are recordings, their altered
/// copies, and the written pieces of is_kept_out. `damaged`: recordings of these groups after some
/// damage; no model is trained on them, they are scored with their group's fold, and their numbers
/// continue after the pieces'. `on_fold(done, all)` is called after each fold. Errors: as
/// train_genres; a genre all of whose pieces are of one group.
[[nodiscard]] Expected<std::vector<WindowScore>> cross_validate(
    std::span<const PieceFeatures> pieces,
    std::span<const PieceFeatures> damaged,
    std::span<const std::string> genres,
    const GenreTrainingPlan& plan,
    const std::function<void(int, int)>& on_fold);

/// Fits the model's fusion to scores of pieces that it, or one like it, was not trained on.
void calibrate(std::span<const WindowScore> held_out, GenreModel& model);

/// Fits fusion weights (>= 0) and class offsets for windows of length `window` (index into
/// kGenreWindows): maximum likelihood of the true classes with an L2 penalty on the offsets.
/// Windows weigh as balanced_weights() says, recordings 1.5 times. `scores`: of pieces that the
/// model was not trained on. With no window of that length: weights of 1 for the evidence that is
/// used.
[[nodiscard]] GenreFusion fit_fusion(std::span<const WindowScore> scores,
                                     std::size_t window,
                                     std::size_t classes,
                                     GenreEvidence evidence);

}  // namespace raks::audio
