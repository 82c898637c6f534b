#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/genre_scores.hpp"
#include "audio/evaluate/piece_features.hpp"
#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"
#include "training/genre/mfcc_trainer.hpp"
#include "training/genre/network_trainer.hpp"
#include "training/genre/pattern_trainer.hpp"

namespace raks::audio {

struct GenreTrainingPlan {
    GenreFeatures features;
    MfccTrainingPlan mfcc;
    PatternTrainingPlan rhythm = rhythm_training();
    PatternTrainingPlan sound = sound_training();
    NetworkTrainingPlan network;
    /// What train_on_written made of all written pieces, one for each of network.networks, so that
    /// no fold learns them again. None: each model learns from its own pieces.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks;
    int folds = 3;  ///< >= 2
};

/// Genres that occur among the pieces: those in `order` first, then the others by name.
[[nodiscard]] std::vector<std::string> genres_of(std::span<const PieceFeatures> pieces,
                                                 std::span<const std::string_view> order);

/// A model of all these pieces; its fusion is the default until calibrate().
/// Errors: no genre, or one with too little sound for its model.
[[nodiscard]] Expected<GenreModel> train_genres(std::span<const PieceFeatures* const> pieces,
                                                std::span<const std::string> genres,
                                                const GenreTrainingPlan& plan);

/// Scores of every recording and its altered copies, and of the written pieces that are kept out,
/// by a model that heard no piece of its group: groups are dealt to folds, genre by genre.
/// `damaged`: recordings of these groups as they are heard after some damage, learnt from by no
/// model and scored by the same as the others of their group; their scores count on from the
/// pieces'. `on_fold(done, all)` is called after each. Errors: as train_genres; a genre all of
/// whose pieces are of one group.
[[nodiscard]] Expected<std::vector<WindowScore>> cross_validate(
    std::span<const PieceFeatures> pieces,
    std::span<const PieceFeatures> damaged,
    std::span<const std::string> genres,
    const GenreTrainingPlan& plan,
    const std::function<void(int, int)>& on_fold);

/// Fits the model's fusion to scores of pieces that it, or one like it, was not trained on.
void calibrate(std::span<const WindowScore> held_out, GenreModel& model);

}  // namespace raks::audio
